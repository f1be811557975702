#pragma once

#include <vector>

#include "globe/planet/grid.h"

namespace converters {

/// Geodetic normals of a square block of nodes, at the cost of one halving a node; bit-equal to
/// globe::planet::node_direction.
class NodeBlock {
 public:
  /// Nodes i0 .. i0 + side, j0 .. j0 + side of diamond d; side is a power of two, i0 and j0 are multiples of
  /// it.
  NodeBlock(int d, int level, int i0, int j0, int side);

  int diamond() const { return d_; }
  int level() const { return level_; }
  int i0() const { return i0_; }
  int j0() const { return j0_; }
  int side() const { return side_; }

  bool holds(int i, int j) const { return i >= i0_ && j >= j0_ && i <= i0_ + side_ && j <= j0_ + side_; }
  const globe::planet::dvec3& at(int i, int j) const {
    return directions_[static_cast<std::size_t>((j - j0_) * (side_ + 1) + (i - i0_))];
  }

 private:
  int d_, level_, i0_, j0_, side_;
  std::vector<globe::planet::dvec3> directions_;
};

}  // namespace converters
