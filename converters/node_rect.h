#pragma once

#include "globe/planet/grid.h"

namespace converters {

/// Nodes i0 .. i0+ni-1, j0 .. j0+nj-1 of a diamond, all of them in it (0 .. 2^level).
struct NodeRect {
  int d = 0, level = 0;
  int i0 = 0, j0 = 0, ni = 0, nj = 0;
};

/// All nodes of a diamond.
inline NodeRect whole_diamond(int d, int level) {
  const int side = globe::planet::nodes_per_side(level) + 1;
  return {d, level, 0, 0, side, side};
}

}  // namespace converters
