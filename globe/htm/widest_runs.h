#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "globe/htm/region.h"

namespace globe::htm {

/// Neighbouring ids of one level, both ends included.
struct Run {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  double area = 0;  ///< steradians, to some per cent
};

/// The widest runs of trixels that all have one relation to a region, by area, in rising order of ids.
///
/// @param wanted  kInside or kDisjoint
/// @param count  of the runs; fewer come when there are no more
/// @param with_ends  the run that begins with the level's first id and the one that ends with its last are
/// among the answer, beside the `count`
std::vector<Run> widest_runs(const Region& region, int level, Relation wanted, std::size_t count,
                             bool with_ends);

}  // namespace globe::htm
