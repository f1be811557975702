#include "globe/search/key_ranges.h"

#include <algorithm>

#include "globe/search/schema.h"

namespace globe::search {

using htm::IdRange;

std::vector<IdRange> key_ranges(const htm::Region& region, bool by_inside) {
  constexpr std::size_t kRanges = 24;
  std::vector<IdRange> ranges;
  int level = 0;
  for (; level <= kIndexLevel; ++level) {
    ranges = htm::cover(region, {level, false, 0, by_inside});
    if (ranges.size() >= kRanges || level == kIndexLevel) break;
  }
  const int shift = 2 * (kIndexLevel - level);
  for (IdRange& range : ranges) range = {range.first << shift, ((range.last + 1) << shift) - 1, range.inside};
  return ranges;
}

std::vector<IdRange> intersection(std::span<const IdRange> a, std::span<const IdRange> b) {
  std::vector<IdRange> both;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    const std::uint64_t first = std::max(i->first, j->first), last = std::min(i->last, j->last);
    if (first <= last) both.push_back({first, last, i->inside && j->inside});
    if (i->last < j->last) {
      ++i;
    } else {
      ++j;
    }
  }
  return both;
}

std::vector<Ancestor> ancestors(std::span<const IdRange> ranges) {
  std::vector<Ancestor> result;
  for (const IdRange& range : ranges) {
    for (int level = 0; level < kIndexLevel; ++level) {
      const int shift = 2 * (kIndexLevel - level);
      const std::uint64_t first = range.first >> shift << shift;
      if (first != range.first) result.push_back({first, level});
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace globe::search
