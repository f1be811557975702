#include "converters/footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace converters {

using globe::planet::dvec3;
using globe::planet::Node;
using globe::planet::node_direction;

namespace {

/// Name with the smallest diamond: all names of a vertex lead to the same arithmetic.
Node canonical(const Node& node) {
  const globe::planet::Names all = globe::planet::names(node);
  return *std::min_element(all.node.begin(), all.node.begin() + all.count, [](const Node& a, const Node& b) {
    return std::array{a.d, a.i, a.j} < std::array{b.d, b.i, b.j};
  });
}

/// The four neighbours of an octahedron corner, in order around it: those along the axes it does not lie on.
int corner_ring(const Node& node, std::array<dvec3, 6>& ring) {
  const dvec3 u = node_direction(node);
  std::vector<dvec3> found;
  for (const auto& step : globe::planet::kLatticeSteps) {
    const dvec3 v =
        node_direction(globe::planet::fold({node.d, node.level, node.i + step.x, node.j + step.y}));
    if (std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
  }
  const dvec3 first = found[0] - glm::dot(found[0], u) * u;
  const dvec3 second = glm::cross(u, first);
  const auto angle = [&](const dvec3& v) { return std::atan2(glm::dot(v, second), glm::dot(v, first)); };
  std::sort(found.begin(), found.end(), [&](const dvec3& a, const dvec3& b) { return angle(a) < angle(b); });
  std::copy(found.begin(), found.end(), ring.begin());
  return static_cast<int>(found.size());
}

int ring_of(const Node& node, std::array<dvec3, 6>& ring) {
  const int n = globe::planet::nodes_per_side(node.level);
  if ((node.i == 0 || node.i == n) && (node.j == 0 || node.j == n)) return corner_ring(node, ring);
  for (std::size_t k = 0; k < globe::planet::kLatticeSteps.size(); ++k) {
    ring[k] =
        node_direction(globe::planet::fold({node.d, node.level, node.i + globe::planet::kLatticeSteps[k].x,
                                            node.j + globe::planet::kLatticeSteps[k].y}));
  }
  return static_cast<int>(globe::planet::kLatticeSteps.size());
}

/// Columns in 360 degrees where a map's columns are longitudes and end somewhere; else 0.
double turn_of(const MapGeometry& geometry) {
  if (geometry.projection) return geometry.projection->turn() / geometry.factor;
  return geometry.period > 0 ? 0.0 : 360.0 / geometry.step_deg;
}

double lowest(const Footprint& footprint, double Footprint::Corner::*of) {
  double value = footprint.corner[0].*of;
  for (std::size_t k = 1; k < static_cast<std::size_t>(footprint.count); ++k)
    value = std::min(value, footprint.corner[k].*of);
  return value;
}
double highest(const Footprint& footprint, double Footprint::Corner::*of) {
  double value = footprint.corner[0].*of;
  for (std::size_t k = 1; k < static_cast<std::size_t>(footprint.count); ++k)
    value = std::max(value, footprint.corner[k].*of);
  return value;
}

}  // namespace

double Footprint::min_x() const { return lowest(*this, &Corner::x); }
double Footprint::max_x() const { return highest(*this, &Corner::x); }
double Footprint::min_y() const { return lowest(*this, &Corner::y); }
double Footprint::max_y() const { return highest(*this, &Corner::y); }

double footprint_reach(int level) { return std::numbers::pi / globe::planet::nodes_per_side(level); }

Footprint make_footprint(const MapGeometry& geometry, const SamplePlace& node,
                         const std::array<SamplePlace, 6>& centres, int count) {
  std::array<Footprint::Corner, 6> corner{};  // relative to the node
  const double turn = turn_of(geometry);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const SamplePlace& place = centres[k];
    if (!place.is_somewhere() || !node.is_somewhere()) return {};
    int columns = place.x.whole - node.x.whole;
    if (geometry.period > 0 && columns > geometry.period / 2) columns -= geometry.period;
    if (geometry.period > 0 && columns < -geometry.period / 2) columns += geometry.period;
    corner[k] = {columns + (place.x.fraction - node.x.fraction),
                 (place.y.whole - node.y.whole) + (place.y.fraction - node.y.fraction)};
    if (turn > 0.0) corner[k].x -= turn * std::round(corner[k].x / turn);
  }
  Footprint footprint;
  footprint.count = count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const Footprint::Corner& opposite =
        corner[(k + static_cast<std::size_t>(count / 2)) % static_cast<std::size_t>(count)];
    // Where a projection is cut or has a singular point, corners are no longer around the node.
    if (geometry.projection && std::hypot(corner[k].x + opposite.x, corner[k].y + opposite.y) >
                                   0.75 * std::hypot(corner[k].x - opposite.x, corner[k].y - opposite.y))
      return {};
    footprint.corner[k] = {node.x.fraction + 0.5 * (corner[k].x - opposite.x),
                           node.y.whole + (node.y.fraction + 0.5 * (corner[k].y - opposite.y))};
  }
  return footprint;
}

Footprint footprint_of(const MapGeometry& geometry, const Node& node) {
  const Node name = canonical(node);
  const dvec3 u = node_direction(name);
  std::array<dvec3, 6> ring{};
  const int count = ring_of(name, ring);
  std::array<dvec3, 7> directions{};
  for (int k = 0; k < count; ++k) {
    const dvec3& next = ring[static_cast<std::size_t>((k + 1) % count)];
    directions[static_cast<std::size_t>(k)] =
        trixel_centre(geometry, u, ring[static_cast<std::size_t>(k)], next);
  }
  directions[6] = u;
  std::array<SamplePlace, 7> places{};
  find_places(geometry, directions.data(), directions.size(), footprint_reach(node.level), places.data());
  std::array<SamplePlace, 6> centres{};
  std::copy_n(places.begin(), centres.size(), centres.begin());
  return make_footprint(geometry, places[6], centres, count);
}

double cap_rim(const MapGeometry& geometry, int level, bool north) {
  const int n = globe::planet::nodes_per_side(level);
  const int pole = north ? 0 : n;
  const int step = north ? 1 : -1;
  const SamplePlace rim = place_of(geometry, trixel_centre(geometry, node_direction({0, level, pole, pole}),
                                                           node_direction({0, level, pole + step, pole}),
                                                           node_direction({0, level, pole, pole + step})));
  return rim.y.whole + rim.y.fraction;
}

}  // namespace converters
