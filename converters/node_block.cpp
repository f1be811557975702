#include "converters/node_block.h"

#include <cassert>

#include "globe/htm/midpoint.h"

namespace converters {

using globe::planet::node_direction;

NodeBlock::NodeBlock(int d, int level, int i0, int j0, int side)
    : d_(d),
      level_(level),
      i0_(i0),
      j0_(j0),
      side_(side),
      directions_(static_cast<std::size_t>((side + 1) * (side + 1))) {
  assert((side & (side - 1)) == 0 && i0 % side == 0 && j0 % side == 0);
  const auto slot = [&](int i, int j) -> globe::planet::dvec3& {
    return directions_[static_cast<std::size_t>(j * (side + 1) + i)];
  };
  for (const int j : {0, side}) {
    for (const int i : {0, side}) slot(i, j) = node_direction({d, level, i0 + i, j0 + j});
  }
  // At each step the nodes that halve an edge of the lattice twice as coarse: along i, along j, and across.
  for (int s = side / 2; s >= 1; s /= 2) {
    for (int j = 0; j <= side; j += s) {
      const bool odd_j = (j / s) % 2 != 0;
      for (int i = odd_j ? 0 : s; i <= side; i += odd_j ? s : 2 * s) {
        const bool odd_i = (i / s) % 2 != 0;
        slot(i, j) = !odd_j   ? globe::htm::midpoint(slot(i - s, j), slot(i + s, j))
                     : !odd_i ? globe::htm::midpoint(slot(i, j - s), slot(i, j + s))
                              : globe::htm::midpoint(slot(i + s, j - s), slot(i - s, j + s));
      }
    }
  }
}

}  // namespace converters
