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

  friend bool operator==(const IdRange&, const IdRange&) = default;
};

struct CoverSettings {
  int level = 0;               ///< of the ids in the ranges, 0..kMaxLevel
  bool inner = false;          ///< trixels wholly in the region, in place of all that touch it
  std::size_t max_ranges = 0;  ///< hard limit, met by refining first the cell that wastes most; 0: none
};

/// The trixels of a region at a level: sorted, disjoint ranges, merged where they meet.
std::vector<IdRange> cover(const Region& region, const CoverSettings& settings);

/// The same ranges in rising order, each handed over as soon as it is complete, in memory that does not grow
/// with their number. REQUIRES: no limit on the ranges.
void visit_cover(const Region& region, const CoverSettings& settings,
                 const std::function<void(const IdRange&)>& visit);

}  // namespace globe::htm
