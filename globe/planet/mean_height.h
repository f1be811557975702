#pragma once

#include <array>
#include <cstddef>

#include "globe/geo/ellipsoid.h"
#include "globe/planet/lattice_trixel.h"

namespace globe::planet {

/// Cells a side of the blocks that heights are averaged in, at levels that have as many; also those of the
/// finest samples of "height_range" and "height_mean" (Dataset).
inline constexpr int kBlockLevels = 3;
inline constexpr int kBlockCells = 1 << kBlockLevels;

/// The finest level of blocks over heights of a level: kBlockLevels coarser, at least 0.
inline int block_level(int height_level) {
  return height_level > kBlockLevels ? height_level - kBlockLevels : 0;
}

/// Heights (metres) of the nodes of a block: those of level `height_level` in one cell of its block level,
/// borders included.
struct HeightBlock {
  int d = 0;
  int height_level = 0;
  int i0 = 0;  ///< the first node
  int j0 = 0;
  std::array<double, (kBlockCells + 1) * (kBlockCells + 1)> values{};

  int cells() const {
    return nodes_per_side(height_level) < kBlockCells ? nodes_per_side(height_level) : kBlockCells;
  }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>((j - j0) * (cells() + 1) + (i - i0));
  }
  /// By the node's coordinates.
  double& at(int i, int j) { return values[index(i, j)]; }
  double at(int i, int j) const { return values[index(i, j)]; }
};

/// Mean height of the ground over a trixel of a block: of the surface that is linear in each trixel of the
/// heights' level, weighted by true area on the ellipsoid.
///
/// The area of each trixel counts as it is down to level 8, and down to two levels above the heights' beyond:
/// what is finer is taken as equal parts, which is right to an eighth of the square of the side, 2e-5 of
/// the area (mean_height_test).
/// @param corners  of the trixel, in the order of its nodes
/// REQUIRES: the trixel lies in the block; its level is between block_level and the heights' level.
/// Error: 2e-5 of the difference between the highest and the lowest height, 1e-7 down to level 8.
double mean_height(const geo::Ellipsoid& ellipsoid, const HeightBlock& heights, const LatticeTrixel& t,
                   const htm::Corners& corners);

/// Mean of a trixel from those of its children, weighted by their areas.
/// @param means  of children(t), in their order
/// @param tolerance  error of an area, of the area: what one child gains, another loses
double mean_of_children(const geo::Ellipsoid& ellipsoid, const htm::Corners& corners,
                        const std::array<double, 4>& means, double tolerance = 1e-8);

}  // namespace globe::planet
