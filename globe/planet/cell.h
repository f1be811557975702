#pragma once

#include "globe/htm/trixel.h"

namespace globe::planet {

/// Half of a grid cell, which is one trixel: diamond d (0..3), level L, cell 0 <= i, j < n = 2^L.
///
/// The cell with corner nodes (i, j) .. (i+1, j+1) is split along its anti-diagonal (i+1, j) - (i, j+1); half
/// 0 holds node (i, j), half 1 node (i+1, j+1).
struct Cell {
  int d = 0;
  int level = 0;
  int i = 0;
  int j = 0;
  int half = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// The cell and half that a trixel is. Integers alone; inverse of `trixel_from_cell`.
Cell cell_from_trixel(htm::Trixel trixel);

/// The trixel that half a cell is. REQUIRES: level <= htm::kMaxLevel, d, i, j, half in range.
htm::Trixel trixel_from_cell(const Cell& cell);

}  // namespace globe::planet
