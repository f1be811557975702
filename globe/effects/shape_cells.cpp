#include "globe/effects/shape_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <iterator>

namespace globe::effects {
namespace {

constexpr double kMap = 360.0;
constexpr std::size_t kFewEdges = 6;  ///< that are not cut again
constexpr int kDeepest = 9;           ///< cells of 0.0027 millidegrees: 30 cm
constexpr int kSide = 8;

/// > 0: c lies to the left of the way from a to b.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// What crossing an edge on the way from one place to another adds to the winding.
int crossing(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec4& edge) {
  const glm::dvec2 a(edge.x, edge.y), b(edge.z, edge.w);
  const bool left_a = turn(from, to, a) >= 0.0, left_b = turn(from, to, b) >= 0.0;
  if (left_a == left_b) return 0;
  const bool before = turn(a, b, from) >= 0.0, after = turn(a, b, to) >= 0.0;
  if (before == after) return 0;
  return after ? 1 : -1;
}

bool meets(const glm::dvec4& edge, double x, double y, double side) {
  const double slack = 1e-6 * side;
  x -= slack;
  y -= slack;
  side += 2.0 * slack;
  if (std::min(edge.x, edge.z) > x + side || std::max(edge.x, edge.z) < x) return false;
  if (std::min(edge.y, edge.w) > y + side || std::max(edge.y, edge.w) < y) return false;
  const glm::dvec2 a(edge.x, edge.y), b(edge.z, edge.w);
  const bool left = turn(a, b, {x, y}) > 0.0;
  return (turn(a, b, {x + side, y}) > 0.0) != left || (turn(a, b, {x, y + side}) > 0.0) != left ||
         (turn(a, b, {x + side, y + side}) > 0.0) != left;
}

double area(const ShapeCells::Ring& ring) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const MapCorner &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += (a.lon_deg - ring[0].lon_deg) * (b.lat_deg - ring[0].lat_deg) -
           (b.lon_deg - ring[0].lon_deg) * (a.lat_deg - ring[0].lat_deg);
  }
  return sum;
}

bool surrounds(const ShapeCells::Ring& ring, const MapCorner& at) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const MapCorner &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((a.lat_deg <= at.lat_deg) == (b.lat_deg <= at.lat_deg)) continue;
    const double t = (at.lat_deg - a.lat_deg) / (b.lat_deg - a.lat_deg);
    if (a.lon_deg + t * (b.lon_deg - a.lon_deg) > at.lon_deg) inside = !inside;
  }
  return inside;
}

/// Inside a ring or on it, beside its first edge.
MapCorner place_on(const ShapeCells::Ring& ring) {
  return {0.5 * (ring[0].lat_deg + ring[1].lat_deg), 0.5 * (ring[0].lon_deg + ring[1].lon_deg)};
}

}  // namespace

ShapeCells::ShapeCells(std::span<const Rings> polygons) {
  for (const Rings& polygon : polygons) add_edges(polygon);
  std::vector<std::uint32_t> edges(all_.size());
  for (std::uint32_t k = 0; k < edges.size(); ++k) edges[k] = k;
  // South of the south pole the map has nothing.
  build({-180.0, -90.0, kMap, 0}, edges, {{-123.4, -100.0}, 0});
  all_ = {};
}

void ShapeCells::add_edges(const Rings& polygon) {
  for (std::size_t r = 0; r < polygon.size(); ++r) {
    const Ring& ring = polygon[r];
    if (ring.size() < 3) continue;
    // A hole winds backward, an island in it forward again.
    int depth = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      depth += k != r && polygon[k].size() >= 3 && surrounds(polygon[k], place_on(ring)) ? 1 : 0;
    const bool reversed = (area(ring) < 0.0) != (depth % 2 != 0);
    // On the map once for each turn by which some of it comes to lie there.
    const auto [west, east] = std::minmax_element(
        ring.begin(), ring.end(), [](const auto& a, const auto& b) { return a.lon_deg < b.lon_deg; });
    for (double turns = std::ceil((-180.0 - east->lon_deg) / kMap); west->lon_deg + kMap * turns < 180.0;
         ++turns) {
      if (east->lon_deg + kMap * turns <= -180.0) continue;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const MapCorner &a = ring[reversed ? (k + 1) % ring.size() : k],
                        &b = ring[reversed ? k : (k + 1) % ring.size()];
        if (a.lat_deg != b.lat_deg || a.lon_deg != b.lon_deg)
          all_.emplace_back(a.lon_deg + kMap * turns, a.lat_deg, b.lon_deg + kMap * turns, b.lat_deg);
      }
    }
  }
}

int ShapeCells::winding_at(const glm::dvec2& at, const std::vector<std::uint32_t>& edges,
                           const Known& known) const {
  int winding = known.winding;
  for (const std::uint32_t k : edges) winding += crossing(known.at, at, all_[k]);
  return winding;
}

std::uint32_t ShapeCells::build(const Cell& cell, const std::vector<std::uint32_t>& edges,
                                const Known& known) {
  const std::size_t first = cells_.size();
  cells_.resize(first + kSide * kSide);
  const double side = cell.side / kSide;
  std::vector<std::uint32_t> inside;
  for (std::size_t k = 0; k < kSide * kSide; ++k) {
    const std::size_t row = k / kSide;
    const Cell part{cell.x + side * static_cast<double>(k % kSide), cell.y + side * static_cast<double>(row),
                    side, cell.depth + 1};
    inside.clear();
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(inside),
                 [&](std::uint32_t e) { return meets(all_[e], part.x, part.y, side); });
    // The place in the cell that is farthest from edges.
    std::uint32_t place = 0;
    double most = -1.0;
    for (std::uint32_t p = 0; p < 4; ++p) {
      const glm::dvec2 at = glm::dvec2(part.x, part.y) + kPlaces[p] * side;
      double least = kMap * kMap;
      for (const std::uint32_t e : inside) {
        const glm::dvec2 a(all_[e].x, all_[e].y), b(all_[e].z, all_[e].w);
        least = std::min(least, std::abs(turn(a, b, at)) / glm::distance(a, b));
      }
      if (least > most) {
        most = least;
        place = p;
      }
    }
    const Known here{glm::dvec2(part.x, part.y) + kPlaces[place] * side, 0};
    const int winding = winding_at(here.at, edges, known);
    glm::uvec2 word;
    if (inside.empty()) {
      word = {0u, static_cast<std::uint32_t>(winding)};
    } else if (inside.size() > kFewEdges && part.depth < kDeepest) {
      word = {1u | build(part, std::vector(inside), {here.at, winding}) << 2, 0u};
    } else {
      word = {2u | static_cast<std::uint32_t>(edges_.size()) << 2,
              static_cast<std::uint32_t>(std::min<std::size_t>(inside.size(), 0xffff)) | place << 16 |
                  static_cast<std::uint32_t>(std::clamp(winding, -2047, 2047) + 2048) << 20};
      for (const std::uint32_t e : inside) edges_.push_back(all_[e]);
    }
    cells_[first + k] = word;
  }
  return static_cast<std::uint32_t>(first / (kSide * kSide));
}

bool ShapeCells::contains(double lat_deg, double lon_deg) const {
  const glm::dvec2 at(lon_deg - kMap * std::floor((lon_deg + 180.0) / kMap), lat_deg);
  glm::dvec2 corner(-180.0, -90.0);
  double side = kMap;
  std::size_t table = 0;
  for (;;) {
    side /= kSide;
    const auto x = std::clamp(static_cast<int>((at.x - corner.x) / side), 0, kSide - 1);
    const auto y = std::clamp(static_cast<int>((at.y - corner.y) / side), 0, kSide - 1);
    corner += glm::dvec2(x, y) * side;
    const glm::uvec2 word = cells_[table * kSide * kSide + static_cast<std::size_t>(y * kSide + x)];
    if ((word.x & 3u) == 0u) return static_cast<int>(word.y) > 0;
    if ((word.x & 3u) == 1u) {
      table = word.x >> 2;
      continue;
    }
    int winding = static_cast<int>(word.y >> 20) - 2048;
    const glm::dvec2 known = corner + kPlaces[word.y >> 16 & 3u] * side;
    for (std::uint32_t k = 0; k < (word.y & 0xffffu); ++k)
      winding += crossing(known, at, edges_[(word.x >> 2) + k]);
    return winding > 0;
  }
}

}  // namespace globe::effects
