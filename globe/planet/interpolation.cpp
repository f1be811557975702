#include "globe/planet/interpolation.h"

#include <algorithm>
#include <array>

#include "globe/planet/lattice_spline.h"
#include "globe/planet/tile_nodes.h"

namespace globe::planet {
namespace {

template <typename HeightOf>
Height interpolate(const HeightOf& height, const Place& place, Interpolation interpolation) {
  const WeightedNodes corners = trixel_nodes(place.d, place.level, place.ij);
  std::array<double, 3> heights{};
  std::transform(corners.nodes.begin(), corners.nodes.end(), heights.begin(), height);
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  Height result{0.0, *high - *low};
  switch (interpolation) {
    case Interpolation::kNearest: {
      const auto nearest = std::max_element(corners.weights.begin(), corners.weights.end());
      result.height_m = heights[static_cast<std::size_t>(nearest - corners.weights.begin())];
      break;
    }
    case Interpolation::kLinear:
      for (std::size_t k = 0; k < 3; ++k) result.height_m += corners.weights[k] * heights[k];
      break;
    case Interpolation::kCubic: {
      const int last = nodes_per_side(place.level) - 1;
      const Node cell{place.d, place.level, std::min(static_cast<int>(place.ij.x), last),
                      std::min(static_cast<int>(place.ij.y), last)};
      result.height_m = lattice_spline(cell, place.ij.x - cell.i, place.ij.y - cell.j, height);
      break;
    }
  }
  return result;
}

}  // namespace

Height height_at(const Surface& surface, const dvec3& u, int level, Interpolation interpolation) {
  return interpolate([&](const Node& node) { return surface.height(node); }, locate(u, level), interpolation);
}

Height data_height_at(const Surface& surface, const dvec3& u, Interpolation interpolation) {
  const DataSource data = surface.data_at(u);
  const int level = data.level;
  if (data.inset.empty()) {
    // Nodes of the planet's own that lie in an inset beside the place have a say as the planet's own.
    return interpolate([&](const Node& node) { return surface.own_height(node); }, locate(u, level),
                       interpolation);
  }
  return interpolate([&](const Node& node) { return surface.data_height(node); }, locate(u, level),
                     interpolation);
}

}  // namespace globe::planet
