#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "globe/htm/cover.h"
#include "globe/htm/region.h"

namespace globe::search {

/// Ranges of level-20 ids that hold a region, sorted and disjoint.
///
/// From the coarsest level that makes two dozen of them, so that a search makes few jumps and looks at few
/// features in vain.
/// @param by_inside  whether ranges wholly in the region are kept apart from others, and marked `inside`
std::vector<htm::IdRange> key_ranges(const htm::Region& region, bool by_inside);

/// What is in both of two lists of ranges; inside if inside in both.
std::vector<htm::IdRange> intersection(std::span<const htm::IdRange> a, std::span<const htm::IdRange> b);

/// A trixel that begins before a range and holds it: what a coarse cover of something may have there.
struct Ancestor {
  std::uint64_t first = 0;  ///< level-20 id
  int level = 0;

  friend auto operator<=>(const Ancestor&, const Ancestor&) = default;
};

/// The ancestors of all ranges, each once. Those that begin where a range begins are found in the range
/// itself.
std::vector<Ancestor> ancestors(std::span<const htm::IdRange> ranges);

}  // namespace globe::search
