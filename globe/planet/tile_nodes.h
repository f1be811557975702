#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "globe/planet/subdivision.h"

namespace globe::planet {

/// Samples at the nodes of a tile and `guard` nodes beyond, row by row, channels interleaved; nodes beyond
/// the diamond's edges are asked for one by one. `read(d, level, i0, j0, ni, nj, out)` as Dataset::read.
template <typename Read>
std::vector<float> read_tile_nodes(const TileId& id, int guard, std::size_t channels, const Read& read) {
  const int n = nodes_per_side(id.level);
  const int i0 = std::max(id.first_i() - guard, 0);
  const int i1 = std::min(id.first_i() + id.cells() + guard, n);
  const int j0 = std::max(id.first_j() - guard, 0);
  const int j1 = std::min(id.first_j() + id.cells() + guard, n);
  const auto row = static_cast<std::size_t>(i1 - i0 + 1) * channels;
  std::vector<float> own(row * static_cast<std::size_t>(j1 - j0 + 1));
  read(id.d, id.level, i0, j0, i1 - i0 + 1, j1 - j0 + 1, own.data());
  const auto stride = static_cast<std::size_t>(id.cells() + 1 + 2 * guard);
  if (own.size() == stride * stride * channels) return own;
  std::vector<float> values(stride * stride * channels);
  float* value = values.data();
  for_each_node(id, guard, [&](int i, int j, const Node& node) {
    if (i >= i0 && i <= i1 && j >= j0 && j <= j1) {
      const float* from =
          &own[static_cast<std::size_t>(j - j0) * row + static_cast<std::size_t>(i - i0) * channels];
      std::copy_n(from, channels, value);
    } else {
      read(node.d, node.level, node.i, node.j, 1, 1, value);
    }
    value += channels;
  });
  return values;
}

/// The three nodes of a trixel, and the weight of each at a place in it.
struct WeightedNodes {
  std::array<Node, 3> nodes;
  std::array<double, 3> weights;

  /// Sum of value(node) by weight; the same bits from every diamond that holds the place.
  template <typename Value>
  double sum(const Value& value) const {
    return weights[0] * value(nodes[0]) + weights[1] * value(nodes[1]) + weights[2] * value(nodes[2]);
  }
};

/// Of the trixel that holds plane coordinates of a level, both in [0, 2^level].
inline WeightedNodes trixel_nodes(int d, int level, const dvec2& ij) {
  const int last = nodes_per_side(level) - 1;
  const int i = std::min(static_cast<int>(ij.x), last);
  const int j = std::min(static_cast<int>(ij.y), last);
  const double x = ij.x - i;
  const double y = ij.y - j;
  const auto at = [&](int di, int dj) { return Node{d, level, i + di, j + dj}; };
  if (x + y <= 1.0) return {{at(0, 0), at(1, 0), at(0, 1)}, {1.0 - x - y, x, y}};
  return {{at(1, 1), at(0, 1), at(1, 0)}, {x + y - 1.0, 1.0 - x, 1.0 - y}};
}

/// The same for a node of a finer level.
inline WeightedNodes trixel_nodes(const Node& node, int level) {
  const double cells = static_cast<double>(nodes_per_side(node.level - level));
  return trixel_nodes(node.d, level, {node.i / cells, node.j / cells});
}

}  // namespace globe::planet
