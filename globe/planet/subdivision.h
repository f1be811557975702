#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "globe/planet/grid.h"

namespace globe::planet {

inline constexpr int kTileCells = 64;  ///< cells a side of a tile, at levels that have as many
inline constexpr int kTileGuard = 4;   ///< nodes a tile holds beyond its own on every side

inline int guard_of(bool own_nodes_only) { return own_nodes_only ? 0 : kTileGuard; }

/// A square of the diamond grid: tile (ti, tj) of diamond d at a level.
struct TileId {
  int d = 0;
  int level = 0;
  int ti = 0;
  int tj = 0;

  friend bool operator==(const TileId&, const TileId&) = default;

  int cells() const { return nodes_per_side(level) < kTileCells ? nodes_per_side(level) : kTileCells; }
  int first_i() const { return ti * cells(); }
  int first_j() const { return tj * cells(); }
  int stride() const { return cells() + 1 + 2 * kTileGuard; }
  TileId parent() const {
    return {d, level - 1, cells() < kTileCells ? 0 : ti / 2, cells() < kTileCells ? 0 : tj / 2};
  }
};

/// The tile that holds a node (on a shared border: the lower one).
TileId tile_of(const Node& node);

/// Values over the nodes of a tile and its guard, in the plane of its diamond: nodes beyond a diamond edge
/// are those the unfolded lattice has there (fold), so that a stencil needs no special case at an edge.
template <typename T>
struct TileValues {
  TileId id;
  int guard;
  std::vector<T> values;

  explicit TileValues(const TileId& tile = {}, T fill = {}, int guard_nodes = kTileGuard)
      : id(tile),
        guard(guard_nodes),
        values(static_cast<std::size_t>(stride()) * static_cast<std::size_t>(stride()), fill) {}

  int stride() const { return id.cells() + 1 + 2 * guard; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j - id.first_j() + guard) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(i - id.first_i() + guard);
  }
  bool holds(int i, int j) const {
    const int x = i - id.first_i() + guard;
    const int y = j - id.first_j() + guard;
    return x >= 0 && y >= 0 && x < stride() && y < stride();
  }
  T& at(int i, int j) { return values[index(i, j)]; }
  const T& at(int i, int j) const { return values[index(i, j)]; }
};

/// The eight nodes of the butterfly stencil around the edge ab, at the coarser level, plane coordinates of
/// one diamond.
///
/// c and d complete the two triangles beside the edge; the wings complete the triangles beyond them.
///
///     wing_ca --- c --- wing_cb
///           .    . .    .
///             a ----- b
///           .    . .    .
///     wing_da --- d --- wing_db
struct Butterfly {
  ivec2 a, b, c, d, wing_ca, wing_cb, wing_da, wing_db;
};

/// Visits the plane coordinates (i, j) of a tile and `guard` nodes beyond it with the node each means.
template <typename Visit>
void for_each_node(const TileId& id, int guard, const Visit& visit) {
  const int n = nodes_per_side(id.level);
  for (int j = id.first_j() - guard; j <= id.first_j() + id.cells() + guard; ++j) {
    for (int i = id.first_i() - guard; i <= id.first_i() + id.cells() + guard; ++i) {
      const bool inside = i >= 0 && j >= 0 && i <= n && j <= n;
      visit(i, j, inside ? Node{id.d, id.level, i, j} : fold({id.d, id.level, i, j}));
    }
  }
}

/// Stencil of the node (i, j) born at a level, in coordinates of the level above it.
Butterfly butterfly(int i, int j);

/// The stencil's value (Dyn, Levin, Gregory 1990, w = 1/16). Symmetric: exchanging a with b or c with d gives
/// the same bits, so a node on a diamond's edge gets the same value from both sides.
template <typename T>
T butterfly_value(T a, T b, T c, T d, T ca, T cb, T da, T db) {
  return (a + b) * T(0.5) + (c + d) * T(0.125) - ((ca + cb) + (da + db)) * T(0.0625);
}

/// Value halfway between a vertex with four neighbours and its neighbour s0; s2 is the neighbour opposite to
/// s0 (Zorin, Schröder, Sweldens 1996, K = 4: 3/4 v + 3/8 s0 - 1/8 s2).
template <typename T>
T corner_value(T v, T s0, T s2) {
  return v * T(0.75) + (s0 * T(0.375) - s2 * T(0.125));
}

/// True when the node is one of the six octahedron corners, which have four triangles around them.
bool is_corner(const Node& node);

/// The neighbour of an octahedron corner opposite to its neighbour `s0` (both at the corner's level; s0 at
/// distance 1).
Node opposite_neighbour(const Node& corner, const Node& s0);

/// Predicts the values of a tile from its parent's: nodes the parent has keep their value, new ones get the
/// modified butterfly stencil. Guard nodes around octahedron corners included. Cost: about 3 ns a node and
/// channel.
void predict(const TileValues<double>& parent, TileValues<double>& child);
void predict(const TileValues<float>& parent, TileValues<float>& child);

/// The whole sphere at a level of at most kTileCells cells: one tile a diamond.
template <typename T>
using Whole = std::array<TileValues<T>, kDiamonds>;

/// The same for the whole sphere at once; fills the tiles' own nodes only, then fill_guard the rest by
/// folding.
void predict(const Whole<double>& parents, Whole<double>& children);
void predict(const Whole<float>& parents, Whole<float>& children);
void fill_guard(Whole<double>& whole);
void fill_guard(Whole<float>& whole);

}  // namespace globe::planet
