#include "globe/clipmap/shading_nodes.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

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
};

/// The lattice's metric over a tile, constant over half-blocks: inside a trixel the grid is nearly affine,
/// but it has kinks along the edges of coarse trixels, which are sides and anti-diagonals of blocks. (At an
/// equatorial corner of a diamond the two halves span 90 degrees each, so a metric across them does not
/// exist.)
class TileMetric {
 public:
  TileMetric(const geo::Ellipsoid& ellipsoid, const TileId& id)
      : id_(id), block_(block_cells(id)), per_side_(id.cells() / block_) {
    std::vector<dvec3> normals(static_cast<std::size_t>((per_side_ + 1) * (per_side_ + 1)));
    for (int y = 0; y <= per_side_; ++y) {
      for (int x = 0; x <= per_side_; ++x) {
        normals[static_cast<std::size_t>(y * (per_side_ + 1) + x)] =
            planet::node_direction({id.d, id.level, id.first_i() + x * block_, id.first_j() + y * block_});
      }
    }
    metrics_.resize(static_cast<std::size_t>(2 * per_side_ * per_side_));
    const dvec3 axis = shading_axis(id.d);
    for (int y = 0; y < per_side_; ++y) {
      for (int x = 0; x < per_side_; ++x) {
        const auto u = [&](int dx, int dy) {
          return normals[static_cast<std::size_t>((y + dy) * (per_side_ + 1) + x + dx)];
        };
        metrics_[static_cast<std::size_t>(2 * (y * per_side_ + x))] =
            half_metric(ellipsoid, axis, u(0, 0), u(1, 0), u(0, 1), block_);
        metrics_[static_cast<std::size_t>(2 * (y * per_side_ + x) + 1)] =
            half_metric(ellipsoid, axis, u(1, 1), u(0, 1), u(1, 0), -block_);
      }
    }
    sin_latitude_.reserve(normals.size());
    for (const dvec3& u : normals) sin_latitude_.push_back(u.z);
  }

  const Metric& at(int i, int j) const {
    const int x = std::min((i - id_.first_i()) / block_, per_side_ - 1);
    const int y = std::min((j - id_.first_j()) / block_, per_side_ - 1);
    const bool upper = (i - id_.first_i() - x * block_) + (j - id_.first_j() - y * block_) > block_;
    return metrics_[static_cast<std::size_t>(2 * (y * per_side_ + x) + (upper ? 1 : 0))];
  }
  double sin_latitude(int i, int j) const {
    const int x = std::min((i - id_.first_i()) / block_, per_side_ - 1);
    const int y = std::min((j - id_.first_j()) / block_, per_side_ - 1);
    const double fx = static_cast<double>(i - id_.first_i() - x * block_) / block_;
    const double fy = static_cast<double>(j - id_.first_j() - y * block_) / block_;
    const double* z = &sin_latitude_[static_cast<std::size_t>(y * (per_side_ + 1) + x)];
    return (z[0] * (1.0 - fx) + z[1] * fx) * (1.0 - fy) +
           (z[per_side_ + 1] * (1.0 - fx) + z[per_side_ + 2] * fx) * fy;
  }

 private:
  static int block_cells(const TileId& id) {
    const int block = id.level >= 11 ? 16 : id.level >= 8 ? 4 : 1;
    return std::min(block, id.cells());
  }

  static Metric half_metric(const geo::Ellipsoid& ellipsoid, const dvec3& axis, const dvec3& u,
                            const dvec3& u_i, const dvec3& u_j, double cells) {
    const dvec3 origin = geo::surface_point(ellipsoid, u);
    const dvec3 along_i = (geo::surface_point(ellipsoid, u_i) - origin) / cells;
    const dvec3 along_j = (geo::surface_point(ellipsoid, u_j) - origin) / cells;
    const dvec3 up = glm::normalize(u + u_i + u_j);
    const dvec3 t1 = glm::normalize(axis - up * glm::dot(up, axis));
    const dvec3 t2 = glm::cross(up, t1);
    // [i1 i2; j1 j2] * (slope1, slope2) = (dh/di, dh/dj)
    const double i_1 = glm::dot(along_i, t1), i_2 = glm::dot(along_i, t2);
    const double j_1 = glm::dot(along_j, t1), j_2 = glm::dot(along_j, t2);
    const double det = i_1 * j_2 - i_2 * j_1;
    return {{j_2 / det, -j_1 / det}, {-i_2 / det, i_1 / det}};
  }

  TileId id_;
  int block_;
  int per_side_;
  std::vector<Metric> metrics_;
  std::vector<double> sin_latitude_;  ///< at the blocks' corners
};

glm::u16vec2 encode_normal(const glm::dvec2& slope) {
  const double scale = 1.0 / std::sqrt(1.0 + glm::dot(slope, slope));
  const auto code = [&](double s) {
    return static_cast<std::uint16_t>(std::lround((std::clamp(-s * scale, -1.0, 1.0) * 0.5 + 0.5) * 65534.0));
  };
  return {code(slope.x), code(slope.y)};
}

std::uint8_t encode_albedo(float linear) {
  return static_cast<std::uint8_t>(std::lrint(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * 255.0f));
}

/// How much of the sea floor's relief is seen through the water above it.
double water_clarity(double height) { return std::exp(height / 25.0); }

/// Nodes on the edges of trixels down to this level, where the lattice bends too much for one metric: by 90
/// degrees about the octahedron's corners, by 1 % on the edges of level 3.
constexpr int kBentLevel = 3;

bool is_bent(const TileId& id, int i, int j) {
  const int n = planet::nodes_per_side(id.level);
  const int within = (n >> std::min(kBentLevel, id.level)) - 1;
  return (i & within) == 0 || (j & within) == 0 || ((i + j) & within) == 0;
}

/// Slope and cavity of a bent node.
void take_exact_slope(const Surface& surface, const SurfaceTile& tile, int i, int j, planet::Ground& ground) {
  const planet::GroundSlope slope = planet::exact_slope(surface, tile, i, j);
  const dvec3 u = planet::node_direction({tile.id.d, tile.id.level, i, j});
  const dvec3 axis = shading_axis(tile.id.d);
  const dvec3 t1 = glm::normalize(axis - u * glm::dot(u, axis));
  ground.slope = {glm::dot(slope.gradient, t1), glm::dot(slope.gradient, glm::cross(u, t1))};
  ground.cavity = slope.cavity;
}

void shade_tile_part(const Surface& surface, const SurfaceTile& tile, const NodeRect& part,
                     const NodeRect& held, const planet::Coloring* coloring, ShadingNodes& ground_nodes) {
  const TileId& id = tile.id;
  const planet::TileValues<double>& h = tile.shading_height();
  const TileMetric metrics(surface.ellipsoid(), id);
  const double edge = std::ldexp(surface.root_edge(), -id.level);
  const bool sea = surface.has_sea();
  const bool bare = surface.has_bare_floor();
  const double exaggeration = surface.exaggeration();
  for (int j = part.j0; j <= part.j1; ++j) {
    for (int i = part.i0; i <= part.i1; ++i) {
      const Metric& metric = metrics.at(i, j);
      const double own = h.at(i, j);
      const double e = h.at(i + 1, j), w = h.at(i - 1, j), s = h.at(i, j + 1), n = h.at(i, j - 1);
      const double se = h.at(i - 1, j + 1), ne = h.at(i + 1, j - 1);
      // Least-squares plane over the six neighbours of the triangular lattice.
      const double di = (2.0 * (e - w) + (ne - se) + (s - n)) / 6.0;
      const double dj = (2.0 * (s - n) + (se - ne) + (e - w)) / 6.0;
      planet::Ground ground = planet::tile_ground(surface, tile, i, j);
      ground.slope = metric.a * di + metric.b * dj;
      ground.cavity = (own - (e + w + s + n + se + ne) / 6.0) / edge;
      if (is_bent(id, i, j)) take_exact_slope(surface, tile, i, j, ground);
      ground.sin_latitude = metrics.sin_latitude(i, j);
      const bool water = sea && ground.height_m < 0.0;
      glm::vec3 color = planet::albedo(ground);
      const bool open_water = planet::is_open_water(ground, color);
      if (coloring != nullptr) color = (*coloring)(ground, color);
      const std::size_t k = static_cast<std::size_t>(j - held.j0) * static_cast<std::size_t>(held.width()) +
                            static_cast<std::size_t>(i - held.i0);
      ground_nodes.normal[k] = encode_normal(water && !bare ? ground.slope * water_clarity(ground.height_m)
                                                            : ground.slope * exaggeration);
      ground_nodes.albedo[k] = {encode_albedo(color.r), encode_albedo(color.g), encode_albedo(color.b),
                                open_water ? 255 : 0};
    }
  }
}

}  // namespace

ShadingNodes make_shading_nodes(const Surface& surface, int level, int d, const NodeRect& nodes,
                                const planet::Coloring* coloring) {
  ShadingNodes ground;
  ground.resize(nodes);
  const int cells = std::min(kTileCells, planet::nodes_per_side(level));
  const int last = planet::nodes_per_side(level) / cells - 1;
  const auto tile_of = [&](int k) { return std::min(k / cells, last); };
  // A node on the side of two tiles is the later one's, so that no two threads write it.
  const auto last_own = [&](int k) { return (k + 1) * cells - (k == last ? 0 : 1); };
  const auto shade = [&](int ti, int tj) {
    const TileId id{d, level, ti, tj};
    const NodeRect part{std::max(nodes.i0, id.first_i()), std::min(nodes.i1, last_own(ti)),
                        std::max(nodes.j0, id.first_j()), std::min(nodes.j1, last_own(tj))};
    shade_tile_part(surface, *surface.tile(id), part, nodes, coloring, ground);
  };
  const tbb::blocked_range2d<int> tiles(tile_of(nodes.j0), tile_of(nodes.j1) + 1, tile_of(nodes.i0),
                                        tile_of(nodes.i1) + 1);
  tbb::parallel_for(tiles, [&](const tbb::blocked_range2d<int>& some) {
    for (int tj = some.rows().begin(); tj < some.rows().end(); ++tj) {
      for (int ti = some.cols().begin(); ti < some.cols().end(); ++ti) shade(ti, tj);
    }
  });
  return ground;
}

}  // namespace globe::clipmap
