#include "globe/planet/interpolation.h"

#include <algorithm>
#include <array>

#include "globe/planet/subdivision.h"

namespace globe::planet {
namespace {

/// A corner of the trixel around a place, and its barycentric weight there.
struct WeightedNode {
  Node node;
  double weight;
};

std::array<WeightedNode, 3> trixel_around(const Place& place, const Node& cell) {
  const double x = place.ij.x - cell.i;
  const double y = place.ij.y - cell.j;
  const auto corner = [&](int di, int dj) { return Node{cell.d, cell.level, cell.i + di, cell.j + dj}; };
  if (x + y <= 1.0) return {{{corner(0, 0), 1.0 - x - y}, {corner(1, 0), x}, {corner(0, 1), y}}};
  return {{{corner(1, 1), x + y - 1.0}, {corner(0, 1), 1.0 - x}, {corner(1, 0), 1.0 - y}}};
}

/// Catmull and Rom's spline between p[1] (t = 0) and p[2] (t = 1), clamped to the range of the four.
double clamped_spline(const std::array<double, 4>& p, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double value = p[1] + 0.5 * ((p[2] - p[0]) * t + (2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3]) * t2 +
                                     (3.0 * (p[1] - p[2]) + p[3] - p[0]) * t3);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  return std::clamp(value, *low, *high);
}

/// The node that a plane coordinate within one of the diamond means. A line along the diamond's border goes
/// on straight through an octahedron corner, seen from whichever side, where `fold` would turn off.
Node continued(const Node& plane) {
  const int n = nodes_per_side(plane.level);
  const Node corner{plane.d, plane.level, std::clamp(plane.i, 0, n), std::clamp(plane.j, 0, n)};
  const bool one_outside = (corner.i != plane.i) != (corner.j != plane.j);
  if (!one_outside || !is_corner(corner)) return fold(plane);
  return opposite_neighbour(corner, {plane.d, plane.level, 2 * corner.i - plane.i, 2 * corner.j - plane.j});
}

double cubic(const Surface& surface, const Place& place, const Node& cell) {
  std::array<double, 4> rows{};
  for (int dj = -1; dj <= 2; ++dj) {
    std::array<double, 4> row{};
    for (int di = -1; di <= 2; ++di) {
      row[static_cast<std::size_t>(di + 1)] =
          surface.height(continued({cell.d, cell.level, cell.i + di, cell.j + dj}));
    }
    rows[static_cast<std::size_t>(dj + 1)] = clamped_spline(row, place.ij.x - cell.i);
  }
  return clamped_spline(rows, place.ij.y - cell.j);
}

}  // namespace

Height height_at(const Surface& surface, const dvec3& u, int level, Interpolation interpolation) {
  const Place place = locate(u, level);
  const int last = nodes_per_side(level) - 1;
  const Node cell{place.d, level, std::min(static_cast<int>(place.ij.x), last),
                  std::min(static_cast<int>(place.ij.y), last)};
  const std::array<WeightedNode, 3> corners = trixel_around(place, cell);
  std::array<double, 3> heights{};
  std::transform(corners.begin(), corners.end(), heights.begin(),
                 [&](const WeightedNode& corner) { return surface.height(corner.node); });
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  Height result{0.0, *high - *low};
  switch (interpolation) {
    case Interpolation::kNearest: {
      const auto nearest = std::max_element(corners.begin(), corners.end(),
                                            [](const auto& a, const auto& b) { return a.weight < b.weight; });
      result.height_m = heights[static_cast<std::size_t>(nearest - corners.begin())];
      break;
    }
    case Interpolation::kLinear:
      for (std::size_t k = 0; k < 3; ++k) result.height_m += corners[k].weight * heights[k];
      break;
    case Interpolation::kCubic:
      result.height_m = cubic(surface, place, cell);
      break;
  }
  return result;
}

}  // namespace globe::planet
