#pragma once

#include <cstddef>
#include <vector>

#include "converters/inset_grid.h"
#include "converters/inset_output.h"

namespace converters {

/// How an inset ends, lengths in edges of its lattice (steps to one of six neighbours).
struct ShapeRule {
  int rim = 16;  ///< from where the data end to where their weight is 1; at least 4
  double widest_gap =
      0;  ///< voids within the data are filled where no node is more than half of it from data
};

/// What came of it, in nodes.
struct ShapeReport {
  std::size_t data = 0;    ///< that had a value
  std::size_t filled = 0;  ///< of voids, now filled
  std::size_t open = 0;    ///< of voids left to what lies below the inset
  int rim = 0;             ///< as wide as it has become: narrower where the data are
};

/// Gives data a smooth end.
///
/// Nodes without a value are outside where they reach what is not in the tiles of the grid, else they are
/// voids. Narrow voids are filled with a surface stretched between their borders. The weight of a node
/// depends on its distance from the outside and from voids that stay open: a smooth step over the rim, whose
/// folds are smoothed away in turn. Values are carried on a few nodes beyond the data, as InsetInfo wants.
/// Everything is the same by each name of a node.
/// @param values  of each channel; NaN where there is none, at the same nodes of all channels
InsetSamples shape_inset(std::vector<InsetGrid<float>> values, const ShapeRule& rule, ShapeReport& report);

}  // namespace converters
