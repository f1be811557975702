#pragma once

#include <array>

#include "globe/htm/trixel.h"
#include "globe/planet/grid.h"

namespace globe::planet {

/// A trixel by its place in the grid: diamond d and level, the node (i, j) of its right angle in the lattice,
/// and which way its legs go. Its nodes are (i, j), (i + sign, j), (i, j + sign); sign is 1 for half 0 of a
/// cell and -1 for half 1 (see Cell).
struct LatticeTrixel {
  int d = 0;
  int level = 0;
  int i = 0;
  int j = 0;
  int sign = 1;

  int cell_i() const { return sign > 0 ? i : i - 1; }
  int cell_j() const { return sign > 0 ? j : j - 1; }
  int half() const { return sign > 0 ? 0 : 1; }
};

/// The half of a cell.
inline LatticeTrixel lattice_trixel(int d, int level, int cell_i, int cell_j, int half) {
  return half == 0 ? LatticeTrixel{d, level, cell_i, cell_j, 1}
                   : LatticeTrixel{d, level, cell_i + 1, cell_j + 1, -1};
}

/// The four trixels of the next level: those at the three nodes, in their order, and the middle one.
inline std::array<LatticeTrixel, 4> children(const LatticeTrixel& t) {
  const int i = 2 * t.i, j = 2 * t.j, s = t.sign;
  return {{{t.d, t.level + 1, i, j, s},
           {t.d, t.level + 1, i + s, j, s},
           {t.d, t.level + 1, i, j + s, s},
           {t.d, t.level + 1, i + s, j + s, -s}}};
}

/// Corners of those children, in the order of their nodes, from those of the trixel: htm::midpoint's bits.
std::array<htm::Corners, 4> children_corners(const htm::Corners& corners);

/// Corners of a trixel, in the order of its nodes, counter-clockwise seen from outside.
htm::Corners corners(const LatticeTrixel& t);

}  // namespace globe::planet
