#include "globe/htm/cover.h"

#include <cassert>

namespace globe::htm {
namespace {

/// Joins ranges that come in rising order, and hands over those that are complete.
class Joiner {
 public:
  explicit Joiner(const std::function<void(const IdRange&)>& visit) : visit_(visit) {}

  void add(const IdRange& range) {
    if (any_ && range.first == range_.last + 1) {
      range_.last = range.last;
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
  IdRange range_;
  bool any_ = false;
};

IdRange descendants(Trixel t, int levels_below) {
  const int shift = 2 * levels_below;
  return {t.id << shift, ((t.id + 1) << shift) - 1};
}

void descend(const Region& region, const CoverSettings& settings, Trixel t, const Corners& corners,
             int levels_below, Joiner& joiner) {
  const Relation relation = region.relation(corners);
  if (relation == Relation::kDisjoint) return;
  if (relation == Relation::kInside || (levels_below == 0 && !settings.inner)) {
    joiner.add(descendants(t, levels_below));
    return;
  }
  if (levels_below == 0) return;
  for (int k = 0; k < 4; ++k)
    descend(region, settings, child(t, k), child_corners(corners, k), levels_below - 1, joiner);
}

}  // namespace

void visit_cover(const Region& region, const CoverSettings& settings,
                 const std::function<void(const IdRange&)>& visit) {
  assert(settings.level >= 0 && settings.level <= kMaxLevel && settings.max_ranges == 0);
  Joiner joiner(visit);
  for (std::uint64_t root = kFirstRoot; root < kFirstRoot + kRoots; ++root)
    descend(region, settings, {root}, corners({root}), settings.level, joiner);
  joiner.finish();
}

std::vector<IdRange> cover(const Region& region, const CoverSettings& settings) {
  std::vector<IdRange> ranges;
  CoverSettings all = settings;
  all.max_ranges = 0;
  visit_cover(region, all, [&](const IdRange& range) { ranges.push_back(range); });
  return ranges;
}

}  // namespace globe::htm
