#include "globe/htm/cover.h"

#include <cassert>

#include "globe/htm/widest_runs.h"

namespace globe::htm {
namespace {

/// Joins ranges that come in rising order, and hands over those that are complete.
class Joiner {
 public:
  Joiner(const std::function<void(const IdRange&)>& visit, bool by_inside)
      : visit_(visit), by_inside_(by_inside) {}

  void add(const IdRange& range) {
    if (any_ && range.first == range_.last + 1 && !(by_inside_ && range.inside != range_.inside)) {
      range_.last = range.last;
      range_.inside = range_.inside && range.inside;
      return;
    }
    finish();
    range_ = range;
    any_ = true;
  }

  void finish() {
    if (any_) visit_(range_);
    any_ = false;
  }

 private:
  const std::function<void(const IdRange&)>& visit_;
  bool by_inside_;
  IdRange range_;
  bool any_ = false;
};

IdRange descendants(Trixel t, int levels_below, bool inside) {
  const int shift = 2 * levels_below;
  return {t.id << shift, ((t.id + 1) << shift) - 1, inside};
}

void descend(const Region& region, const CoverSettings& settings, Trixel t, const Corners& corners,
             int levels_below, Joiner& joiner) {
  const Relation relation = region.relation(corners);
  if (relation == Relation::kDisjoint) return;
  if (relation == Relation::kInside || (levels_below == 0 && !settings.inner)) {
    joiner.add(descendants(t, levels_below, relation == Relation::kInside));
    return;
  }
  if (levels_below == 0) return;
  const std::array<Corners, 4> children = children_corners(corners);
  for (std::size_t k = 0; k < 4; ++k)
    descend(region, settings, {t.id << 2 | k}, children[k], levels_below - 1, joiner);
}

/// Whether all trixels of a range lie in the region.
bool all_inside(const Region& region, int level, const IdRange& range) {
  bool all = true;
  for_each_whole_trixel(level, range,
                        [&](Trixel t) { all = all && region.relation(corners(t)) == Relation::kInside; });
  return all;
}

std::vector<IdRange> inner_within(const Region& region, int level, std::size_t max_ranges) {
  std::vector<IdRange> ranges;
  for (const Run& run : widest_runs(region, level, Relation::kInside, max_ranges, false))
    ranges.push_back({run.first, run.last, true});
  return ranges;
}

/// All ids but the widest gaps: one fewer between ranges than there are ranges, and those at both ends.
std::vector<IdRange> outer_within(const Region& region, int level, std::size_t max_ranges) {
  std::vector<IdRange> ranges;
  std::uint64_t first = kFirstRoot << (2 * level);
  const std::uint64_t end = (kFirstRoot + kRoots) << (2 * level);
  const auto add = [&](std::uint64_t last) {
    if (first <= last) ranges.push_back({first, last, all_inside(region, level, {first, last})});
  };
  for (const Run& gap : widest_runs(region, level, Relation::kDisjoint, max_ranges - 1, true)) {
    add(gap.first - 1);
    first = gap.last + 1;
  }
  add(end - 1);
  return ranges;
}

}  // namespace

void visit_cover(const Region& region, const CoverSettings& settings,
                 const std::function<void(const IdRange&)>& visit) {
  assert(settings.level >= 0 && settings.level <= kMaxLevel && settings.max_ranges == 0);
  Joiner joiner(visit, settings.by_inside);
  for (std::uint64_t root = kFirstRoot; root < kFirstRoot + kRoots; ++root)
    descend(region, settings, {root}, corners({root}), settings.level, joiner);
  joiner.finish();
}

std::vector<IdRange> cover(const Region& region, const CoverSettings& settings) {
  if (settings.max_ranges > 0) {
    return settings.inner ? inner_within(region, settings.level, settings.max_ranges)
                          : outer_within(region, settings.level, settings.max_ranges);
  }
  std::vector<IdRange> ranges;
  visit_cover(region, settings, [&](const IdRange& range) { ranges.push_back(range); });
  return ranges;
}

}  // namespace globe::htm
