#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "globe/htm/region.h"

namespace globe::htm {

/// Trixels first .. last of one level, both included.
struct IdRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  bool inside = false;  ///< every one of them lies wholly in the region, for certain

  friend bool operator==(const IdRange&, const IdRange&) = default;
};

struct CoverSettings {
  int level = 0;               ///< of the ids in the ranges, 0..kMaxLevel
  bool inner = false;          ///< trixels wholly in the region, in place of all that touch it
  std::size_t max_ranges = 0;  ///< hard limit (see `cover`); 0: none
  /// Ranges end where trixels wholly in the region meet others, so that each is one or the other: what a
  /// search may take without a look, and what it has to look at. REQUIRES: no limit on the ranges.
  bool by_inside = false;
};

/// The trixels of a region at a level: sorted, disjoint ranges, merged where they meet.
///
/// Under a limit the outer cover is what the widest gaps between ids of the region leave, and the inner one
/// is its widest runs of ids: for a number of ranges no cover can have less (more) area. They are found from
/// coarse to fine; a trixel is refined only while a gap (run) through it could still be among the chosen, so
/// that the work follows the number of ranges, not the level. When enough are found, their ends stop being
/// refined where all of them together would gain less than a thousandth of the cover's area. A cover that
/// fits the limit as it is comes out whole.
std::vector<IdRange> cover(const Region& region, const CoverSettings& settings);

/// The same ranges in rising order, each handed over as soon as it is complete, in memory that does not grow
/// with their number. REQUIRES: no limit on the ranges.
void visit_cover(const Region& region, const CoverSettings& settings,
                 const std::function<void(const IdRange&)>& visit);

/// Hands over the largest trixels that make up a range of ids of a level, in rising order.
template <typename Visit>
void for_each_whole_trixel(int level, const IdRange& range, const Visit& visit) {
  for (std::uint64_t first = range.first; first <= range.last;) {
    int up = 0;  // levels by which the trixel that begins here can be coarser
    while (up < level && first % (4ULL << (2 * up)) == 0 && first + (4ULL << (2 * up)) - 1 <= range.last)
      ++up;
    visit(Trixel{first >> (2 * up)});
    first += 1ULL << (2 * up);
  }
}

}  // namespace globe::htm
