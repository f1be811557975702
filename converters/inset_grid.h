#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <vector>

#include "globe/planet/dataset.h"
#include "globe/planet/grid.h"

namespace converters {

/// Values at nodes of one level, where an inset lies: in tiles, which come to be where a value is first set.
/// All other nodes have one value, `elsewhere`.
template <typename T>
class InsetGrid {
 public:
  static constexpr int kTile = 64;  ///< nodes a side

  /// @param bounds  where values may be set, at most one block a diamond
  InsetGrid(int level, const std::vector<globe::planet::InsetBlock>& bounds, T elsewhere)
      : level_(level), elsewhere_(elsewhere), bounds_(bounds) {
    for (const globe::planet::InsetBlock& block : bounds) {
      Diamond& diamond = diamonds_[static_cast<std::size_t>(block.d)];
      diamond.ti = block.i0 / kTile;
      diamond.tj = block.j0 / kTile;
      diamond.across = block.i1 / kTile - diamond.ti + 1;
      diamond.down = block.j1 / kTile - diamond.tj + 1;
      diamond.tiles.resize(static_cast<std::size_t>(diamond.across) * static_cast<std::size_t>(diamond.down));
    }
  }

  int level() const { return level_; }
  const std::vector<globe::planet::InsetBlock>& bounds() const { return bounds_; }

  /// One diamond's node, 0 <= i, j <= 2^level.
  T get(int d, int i, int j) const {
    const Diamond& diamond = diamonds_[static_cast<std::size_t>(d)];
    const std::size_t at = diamond.index(i / kTile, j / kTile);
    if (at == kNowhere || !diamond.tiles[at]) return elsewhere_;
    return diamond.tiles[at][inside(i, j)];
  }
  T get(const globe::planet::Node& node) const { return get(node.d, node.i, node.j); }

  /// Whether the node's tile has come to be.
  bool has(const globe::planet::Node& node) const {
    const Diamond& diamond = diamonds_[static_cast<std::size_t>(node.d)];
    const std::size_t at = diamond.index(node.i / kTile, node.j / kTile);
    return at != kNowhere && diamond.tiles[at];
  }
  /// Sets a node in its diamond alone; makes the tile. Not while others use the grid.
  void set(int d, int i, int j, T value) {
    Diamond& diamond = diamonds_[static_cast<std::size_t>(d)];
    const std::size_t at = diamond.index(i / kTile, j / kTile);
    assert(at != kNowhere);
    if (!diamond.tiles[at]) {
      diamond.tiles[at] = std::make_unique<T[]>(kTile * kTile);
      std::fill_n(diamond.tiles[at].get(), kTile * kTile, elsewhere_);
    }
    diamond.tiles[at][inside(i, j)] = value;
  }
  /// Sets a node in every diamond that has it.
  void set_all_names(const globe::planet::Node& node, T value) {
    const int n = globe::planet::nodes_per_side(level_);
    if (node.i > 0 && node.j > 0 && node.i < n && node.j < n) return set(node.d, node.i, node.j, value);
    const globe::planet::Names all = globe::planet::names(node);
    for (int k = 0; k < all.count; ++k) {
      const globe::planet::Node& name = all.node[static_cast<std::size_t>(k)];
      set(name.d, name.i, name.j, value);
    }
  }

  /// A tile that has come to be: its nodes are i0 .. i1, j0 .. j1, all in the diamond.
  struct Tile {
    int d, i0, i1, j0, j1;
  };
  std::vector<Tile> tiles() const {
    const int n = globe::planet::nodes_per_side(level_);
    std::vector<Tile> found;
    for (int d = 0; d < globe::planet::kDiamonds; ++d) {
      const Diamond& diamond = diamonds_[static_cast<std::size_t>(d)];
      for (std::size_t k = 0; k < diamond.tiles.size(); ++k) {
        if (!diamond.tiles[k]) continue;
        const int i = (diamond.ti + static_cast<int>(k) % diamond.across) * kTile;
        const int j = (diamond.tj + static_cast<int>(k) / diamond.across) * kTile;
        found.push_back({d, i, std::min(i + kTile - 1, n), j, std::min(j + kTile - 1, n)});
      }
    }
    return found;
  }

 private:
  static constexpr std::size_t kNowhere = ~std::size_t{0};

  struct Diamond {
    int ti = 0, tj = 0, across = 0, down = 0;  ///< of the bounds, tiles
    std::vector<std::unique_ptr<T[]>> tiles;

    std::size_t index(int column, int row) const {
      const int x = column - ti, y = row - tj;
      if (x < 0 || y < 0 || x >= across || y >= down) return kNowhere;
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x);
    }
  };
  static std::size_t inside(int i, int j) { return static_cast<std::size_t>(j % kTile * kTile + i % kTile); }

  int level_;
  T elsewhere_;
  std::vector<globe::planet::InsetBlock> bounds_;
  std::array<Diamond, globe::planet::kDiamonds> diamonds_;
};

/// The one of a node's names that stands for all of them.
inline globe::planet::Node first_name(const globe::planet::Node& node) {
  const int n = globe::planet::nodes_per_side(node.level);
  if (node.i > 0 && node.j > 0 && node.i < n && node.j < n) return node;
  const globe::planet::Names all = globe::planet::names(node);
  return *std::min_element(all.node.begin(), all.node.begin() + all.count,
                           [](const globe::planet::Node& a, const globe::planet::Node& b) {
                             return std::array{a.d, a.i, a.j} < std::array{b.d, b.i, b.j};
                           });
}
inline bool is_first_name(const globe::planet::Node& node) { return first_name(node) == node; }

/// Visits every node of the tiles that have come to be, once for each vertex: visit(node).
template <typename T, typename Visit>
void for_each_vertex(const InsetGrid<T>& grid, const Visit& visit) {
  for (const auto& tile : grid.tiles()) {
    for (int j = tile.j0; j <= tile.j1; ++j) {
      for (int i = tile.i0; i <= tile.i1; ++i) {
        const globe::planet::Node node{tile.d, grid.level(), i, j};
        if (is_first_name(node)) visit(node);
      }
    }
  }
}

}  // namespace converters
