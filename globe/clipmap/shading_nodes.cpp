#include "globe/clipmap/shading_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/planet/appearance.h"
#include "globe/planet/grid.h"

namespace globe::clipmap {
namespace {

using planet::kTileCells;
using planet::Surface;
using planet::SurfaceTile;
using planet::TileId;

/// How steps along the lattice turn into slopes: (∂h along t1, ∂h along t2) = a·(dh/di) + b·(dh/dj), dh per
/// cell, slopes m/m.
struct Metric {
  glm::dvec2 a{0.0};
  glm::dvec2 b{0.0};
  double sin_latitude = 0;

  Metric operator*(double k) const { return {a * k, b * k, sin_latitude * k}; }
  Metric operator+(const Metric& other) const {
    return {a + other.a, b + other.b, sin_latitude + other.sin_latitude};
  }
};

Metric metric_at(const geo::Ellipsoid& ellipsoid, int level, int d, int i, int j) {
  const int n = planet::nodes_per_side(level);
  const auto direction = [&](int x, int y) { return planet::node_direction({d, level, x, y}); };
  const int i0 = std::max(i - 1, 0);
  const int i1 = std::min(i + 1, n);
  const int j0 = std::max(j - 1, 0);
  const int j1 = std::min(j + 1, n);
  const dvec3 u = direction(i, j);
  const auto surface = [&](int x, int y) { return geo::surface_point(ellipsoid, direction(x, y)); };
  const dvec3 along_i = (surface(i1, j) - surface(i0, j)) / static_cast<double>(i1 - i0);
  const dvec3 along_j = (surface(i, j1) - surface(i, j0)) / static_cast<double>(j1 - j0);
  const dvec3 axis = shading_axis(d);
  const dvec3 t1 = glm::normalize(axis - u * glm::dot(u, axis));
  const dvec3 t2 = glm::cross(u, t1);
  // [i1 i2; j1 j2] * (slope1, slope2) = (dh/di, dh/dj)
  const double i_1 = glm::dot(along_i, t1), i_2 = glm::dot(along_i, t2);
  const double j_1 = glm::dot(along_j, t1), j_2 = glm::dot(along_j, t2);
  const double det = i_1 * j_2 - i_2 * j_1;
  return {{j_2 / det, -j_1 / det}, {-i_2 / det, i_1 / det}, u.z};
}

glm::u16vec2 encode_normal(const glm::dvec2& slope) {
  const double scale = 1.0 / std::sqrt(1.0 + glm::dot(slope, slope));
  const auto code = [&](double s) {
    return static_cast<std::uint16_t>(std::lround((std::clamp(-s * scale, -1.0, 1.0) * 0.5 + 0.5) * 65534.0));
  };
  return {code(slope.x), code(slope.y)};
}

std::uint8_t encode_albedo(float linear) {
  return static_cast<std::uint8_t>(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * 255.0f + 0.5f);
}

/// How much of the sea floor's relief is seen through the water above it.
double water_clarity(double height) { return std::exp(height / 60.0); }

void shade_tile_part(const Surface& surface, const SurfaceTile& tile, const NodeRect& part,
                     ShadingBlock& block) {
  const TileId& id = tile.id;
  const planet::TileValues<double>& h = tile.shading_height();
  const int step = std::min(16, id.cells());
  const int per_side = id.cells() / step + 1;
  std::vector<Metric> metrics(static_cast<std::size_t>(per_side * per_side));
  for (int y = 0; y < per_side; ++y) {
    for (int x = 0; x < per_side; ++x) {
      metrics[static_cast<std::size_t>(y * per_side + x)] =
          metric_at(surface.ellipsoid(), id.level, id.d, id.first_i() + x * step, id.first_j() + y * step);
    }
  }
  const double edge = std::ldexp(surface.root_edge(), -id.level);
  const bool sea = surface.has_sea();
  planet::Ground ground;
  ground.edge_m = edge;
  ground.has_color = surface.has_colors();
  ground.has_sea = sea;
  for (int j = part.j0; j <= part.j1; ++j) {
    const int my = std::min((j - id.first_j()) / step, per_side - 2);
    const double fy = static_cast<double>(j - id.first_j() - my * step) / step;
    for (int i = part.i0; i <= part.i1; ++i) {
      const int mx = std::min((i - id.first_i()) / step, per_side - 2);
      const double fx = static_cast<double>(i - id.first_i() - mx * step) / step;
      const Metric* m = &metrics[static_cast<std::size_t>(my * per_side + mx)];
      const Metric metric = (m[0] * (1.0 - fx) + m[1] * fx) * (1.0 - fy) +
                            (m[per_side] * (1.0 - fx) + m[per_side + 1] * fx) * fy;
      const double own = h.at(i, j);
      const double e = h.at(i + 1, j), w = h.at(i - 1, j), s = h.at(i, j + 1), n = h.at(i, j - 1);
      const double se = h.at(i - 1, j + 1), ne = h.at(i + 1, j - 1);
      // Least-squares plane over the six neighbours of the triangular lattice.
      const double di = (2.0 * (e - w) + (ne - se) + (s - n)) / 6.0;
      const double dj = (2.0 * (s - n) + (se - ne) + (e - w)) / 6.0;
      ground.slope = metric.a * di + metric.b * dj;
      ground.height_m = tile.height.at(i, j);
      ground.cavity = (own - (e + w + s + n + se + ne) / 6.0) / edge;
      ground.sin_latitude = metric.sin_latitude;
      ground.roughness = tile.channel(planet::Channel::kRoughness).at(i, j);
      ground.mottle = tile.channel(planet::Channel::kMottle).at(i, j);
      ground.color = {tile.channel(planet::Channel::kRed).at(i, j),
                      tile.channel(planet::Channel::kGreen).at(i, j),
                      tile.channel(planet::Channel::kBlue).at(i, j)};
      const bool water = sea && ground.height_m < 0.0;
      const glm::vec3 color = planet::albedo(ground);
      const std::size_t k =
          static_cast<std::size_t>(j - block.nodes.j0) * static_cast<std::size_t>(block.nodes.width()) +
          static_cast<std::size_t>(i - block.nodes.i0);
      block.normal[k] = encode_normal(water ? ground.slope * water_clarity(ground.height_m) : ground.slope);
      block.albedo[k] = {encode_albedo(color.r), encode_albedo(color.g), encode_albedo(color.b),
                         water ? 255 : 0};
    }
  }
}

}  // namespace

ShadingBlock make_shading_block(const Surface& surface, int level, int d, const NodeRect& nodes) {
  ShadingBlock block{d, nodes, {}, {}};
  const auto count = static_cast<std::size_t>(nodes.width()) * static_cast<std::size_t>(nodes.height());
  block.albedo.resize(count);
  block.normal.resize(count);
  const int cells = std::min(kTileCells, planet::nodes_per_side(level));
  const int last = planet::nodes_per_side(level) / cells - 1;
  for (int tj = std::min(nodes.j0 / cells, last); tj <= std::min(nodes.j1 / cells, last); ++tj) {
    for (int ti = std::min(nodes.i0 / cells, last); ti <= std::min(nodes.i1 / cells, last); ++ti) {
      const TileId id{d, level, ti, tj};
      const NodeRect part{std::max(nodes.i0, id.first_i()), std::min(nodes.i1, id.first_i() + cells),
                          std::max(nodes.j0, id.first_j()), std::min(nodes.j1, id.first_j() + cells)};
      shade_tile_part(surface, *surface.tile(id), part, block);
    }
  }
  return block;
}

}  // namespace globe::clipmap
