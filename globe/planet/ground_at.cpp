#include <algorithm>
#include <array>
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

GroundSlope exact_slope(const Surface& surface, const SurfaceTile& tile, int i, int j) {
  const TileValues<double>& h = tile.shading_height();
  const Node own{tile.id.d, tile.id.level, i, j};
  const dvec3 u = node_direction(own);
  const dvec3 place = geo::surface_point(surface.ellipsoid(), u);
  const dvec3 t1 = glm::normalize(glm::cross(u, std::abs(u.z) < 0.7 ? dvec3(0, 0, 1) : dvec3(1, 0, 0)));
  const dvec3 t2 = glm::cross(u, t1);
  std::array<ivec3, kLatticeSteps.size()> met{};
  std::size_t count = 0;
  double rises = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0, xh = 0.0, yh = 0.0;
  for (const ivec2& step : kLatticeSteps) {
    const Node node = fold({own.d, own.level, i + step.x, j + step.y});
    const ivec3 key = octahedral_key(node);
    const auto end = met.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(met.begin(), end, key) != end) continue;  // around a corner of the octahedron
    met[count++] = key;
    const dvec3 away = geo::surface_point(surface.ellipsoid(), node_direction(node)) - place;
    const double x = glm::dot(away, t1), y = glm::dot(away, t2);
    const double rise = h.at(i + step.x, j + step.y) - h.at(i, j);
    rises += rise;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xh += x * rise;
    yh += y * rise;
  }
  return {(t1 * (yy * xh - xy * yh) + t2 * (xx * yh - xy * xh)) / (xx * yy - xy * xy),
          -rises / static_cast<double>(count) / std::ldexp(surface.root_edge(), -tile.id.level)};
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
  ground.bare_floor = surface.has_bare_floor();
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
