#include "globe/clipmap/vertex_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "globe/planet/directions.h"

namespace globe::clipmap {
namespace {

using planet::kTileCells;
using planet::Surface;
using planet::SurfaceTile;
using planet::TileId;

/// Calls visit(tile, part) for the tiles that hold a rectangle of nodes, `part` being what each has of it.
template <typename Visit>
void for_each_tile(const Surface& surface, int level, int d, const NodeRect& nodes, Visit visit) {
  const int cells = std::min(kTileCells, planet::nodes_per_side(level));
  const int last = planet::nodes_per_side(level) / cells - 1;
  for (int tj = std::min(nodes.j0 / cells, last); tj <= std::min(nodes.j1 / cells, last); ++tj) {
    for (int ti = std::min(nodes.i0 / cells, last); ti <= std::min(nodes.i1 / cells, last); ++ti) {
      const TileId id{d, level, ti, tj};
      visit(*surface.tile(id),
            intersect(nodes, {id.first_i(), id.first_i() + cells, id.first_j(), id.first_j() + cells}));
    }
  }
}

std::size_t count_of(const NodeRect& nodes) {
  return static_cast<std::size_t>(nodes.width()) * static_cast<std::size_t>(nodes.height());
}

std::size_t index_in(const NodeRect& nodes, int i, int j) {
  return static_cast<std::size_t>(j - nodes.j0) * static_cast<std::size_t>(nodes.width()) +
         static_cast<std::size_t>(i - nodes.i0);
}

/// place(u, h) for every node of a rectangle, u its normal and h its drawn height.
template <typename Place>
PositionGrid place_nodes(const Surface& surface, int level, int d, const NodeRect& nodes, Place place) {
  PositionGrid grid{nodes, {}};
  grid.values.resize(count_of(nodes));
  for_each_tile(surface, level, d, nodes, [&](const SurfaceTile& tile, const NodeRect& part) {
    const planet::TileValues<dvec3> directions = planet::node_directions(tile.id, 0);
    for (int j = part.j0; j <= part.j1; ++j) {
      for (int i = part.i0; i <= part.i1; ++i) {
        const double h = surface.mesh_height(tile.height.at(i, j));
        grid.values[index_in(nodes, i, j)] = glm::dvec4(place(directions.at(i, j), h), h);
      }
    }
  });
  return grid;
}

/// E(u) + h u in single precision throughout.
PositionGrid single_positions(const Surface& surface, int level, int d, const NodeRect& nodes) {
  const geo::Ellipsoid& ellipsoid = surface.ellipsoid();
  const glm::vec3 squares(
      glm::dvec3(ellipsoid.a * ellipsoid.a, ellipsoid.a * ellipsoid.a, ellipsoid.b() * ellipsoid.b()));
  return place_nodes(surface, level, d, nodes, [&](const dvec3& normal, double h) {
    const glm::vec3 u(normal);
    const glm::vec3 along = squares * u;
    const float scale = 1.0f / std::sqrt(along.x * u.x + along.y * u.y + along.z * u.z);
    return dvec3(along * scale + static_cast<float>(h) * u);
  });
}

/// Grown to even corners on every side, so that both ends of every halved edge are inside.
NodeRect with_parents(const NodeRect& rect, int n) {
  const auto down = [](int x) { return x & ~1; };
  return {std::max(down(rect.i0 - 1), 0), std::min(down(rect.i1 + 2), n), std::max(down(rect.j0 - 1), 0),
          std::min(down(rect.j1 + 2), n)};
}

/// @param grid  of the nodes with their parents
VertexBlock positions_block(int d, const NodeRect& nodes, const PositionGrid& grid) {
  VertexBlock block{d, nodes, {}, {}, {}, {}};
  block.position.reserve(count_of(nodes));
  block.coarse.reserve(count_of(nodes));
  for (int j = nodes.j0; j <= nodes.j1; ++j) {
    for (int i = nodes.i0; i <= nodes.i1; ++i) {
      const glm::dvec4& own = grid.at(i, j);
      block.position.emplace_back(own);
      if (((i | j) & 1) == 0) {
        block.coarse.emplace_back(own);
        continue;
      }
      const auto ends = planet::halved_edge(i, j);
      block.coarse.emplace_back((grid.at(ends[0].x, ends[0].y) + grid.at(ends[1].x, ends[1].y)) * 0.5);
    }
  }
  return block;
}

VertexBlock interpolated_block(const Settings& settings, const Surface& surface, int level, int d,
                               const NodeRect& nodes, const dvec3& anchor) {
  VertexBlock block{d, nodes, {}, {}, {}, make_knots(settings, surface.ellipsoid(), level, d, nodes, anchor)};
  block.height.resize(count_of(nodes));
  for_each_tile(surface, level, d, nodes, [&](const SurfaceTile& tile, const NodeRect& part) {
    for (int j = part.j0; j <= part.j1; ++j) {
      for (int i = part.i0; i <= part.i1; ++i)
        block.height[index_in(nodes, i, j)] = static_cast<float>(surface.mesh_height(tile.height.at(i, j)));
    }
  });
  block.position.reserve(count_of(nodes));
  for (int j = nodes.j0; j <= nodes.j1; ++j) {
    for (int i = nodes.i0; i <= nodes.i1; ++i) {
      const float h = block.height[index_in(nodes, i, j)];
      block.position.emplace_back(patch_surface(settings, block.knots, i, j, h), h);
    }
  }
  return block;
}

}  // namespace

std::size_t VertexBlock::upload_bytes() const {
  if (!height.empty())
    return height.size() * sizeof(float) + (knots.surface.size() + knots.normal.size()) * sizeof(glm::vec4);
  return (position.size() + coarse.size()) * sizeof(glm::vec4);
}

PositionGrid exact_positions(const Surface& surface, int level, int d, const NodeRect& nodes,
                             const dvec3& anchor) {
  return place_nodes(surface, level, d, nodes, [&](const dvec3& u, double h) {
    return geo::ecef_from_normal(surface.ellipsoid(), u, h) - anchor;
  });
}

VertexBlock make_vertex_block(const Settings& settings, const Surface& surface, int level, int d,
                              const NodeRect& nodes, const dvec3& anchor) {
  if (is_interpolated(settings.positions))
    return interpolated_block(settings, surface, level, d, nodes, anchor);
  const NodeRect grown = with_parents(nodes, planet::nodes_per_side(level));
  return positions_block(d, nodes,
                         settings.positions == Positions::kFloat32
                             ? single_positions(surface, level, d, grown)
                             : exact_positions(surface, level, d, grown, anchor));
}

}  // namespace globe::clipmap
