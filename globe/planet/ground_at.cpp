#include <cmath>
#include <glm/geometric.hpp>

#include "globe/planet/appearance.h"

namespace globe::planet {

GroundSlope slope_at(const Surface& surface, const SurfaceTile& tile, const TileValues<dvec3>& directions,
                     int i, int j) {
  const TileValues<double>& h = tile.shading_height();
  const double radius = surface.ellipsoid().mean_radius();
  const dvec3& u = directions.at(i, j);
  const auto seen = [&](int x, int y) { return surface.drawn_height(h.at(x, y)); };
  // Two lattice axes span the tangent plane; their reciprocal basis turns the two rises into a gradient.
  const dvec3 a = (directions.at(i + 1, j) - directions.at(i - 1, j)) * radius;
  const dvec3 b = (directions.at(i, j + 1) - directions.at(i, j - 1)) * radius;
  const dvec3 normal = glm::cross(a, b);
  const double area = glm::dot(normal, u);
  GroundSlope result;
  if (area != 0.0) {
    const double rise_a = seen(i + 1, j) - seen(i - 1, j);
    const double rise_b = seen(i, j + 1) - seen(i, j - 1);
    result.gradient = (glm::cross(b, u) * rise_a + glm::cross(u, a) * rise_b) / area;
  }
  const double mean = (seen(i + 1, j) + seen(i - 1, j) + seen(i, j + 1) + seen(i, j - 1) +
                       seen(i + 1, j - 1) + seen(i - 1, j + 1)) /
                      6.0;
  result.cavity = (seen(i, j) - mean) / std::ldexp(surface.root_edge(), -tile.id.level);
  return result;
}

Ground tile_ground(const Surface& surface, const SurfaceTile& tile, int i, int j) {
  const auto channel = [&](Channel c) { return tile.value(c, i, j); };
  Ground ground;
  ground.height_m = tile.height.at(i, j);
  ground.edge_m = std::ldexp(surface.root_edge(), -tile.id.level);
  ground.roughness = channel(Channel::kRoughness);
  ground.prominence = channel(Channel::kProminence);
  ground.moisture = channel(Channel::kMoisture);
  ground.mottle = channel(Channel::kMottle);
  ground.color = {channel(Channel::kRed), channel(Channel::kGreen), channel(Channel::kBlue)};
  ground.has_color = surface.has_colors();
  ground.has_sea = surface.has_sea();
  ground.airless = surface.is_airless();
  return ground;
}

Ground ground_at(const Surface& surface, const SurfaceTile& tile, const TileValues<dvec3>& directions, int i,
                 int j) {
  const GroundSlope slope = slope_at(surface, tile, directions, i, j);
  Ground ground = tile_ground(surface, tile, i, j);
  ground.slope = {glm::length(slope.gradient), 0.0};
  ground.cavity = slope.cavity;
  ground.sin_latitude = directions.at(i, j).z;
  return ground;
}

}  // namespace globe::planet
