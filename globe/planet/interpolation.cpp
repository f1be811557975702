#include "globe/planet/interpolation.h"

#include <algorithm>
#include <array>

#include "globe/planet/lattice_spline.h"

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
      result.height_m = lattice_spline(cell, place.ij.x - cell.i, place.ij.y - cell.j,
                                       [&](const Node& node) { return surface.height(node); });
      break;
  }
  return result;
}

}  // namespace globe::planet
