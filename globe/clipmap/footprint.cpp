#include "globe/clipmap/footprint.h"

#include <algorithm>
#include <map>

namespace globe::clipmap {
namespace {

struct Span {
  int first, last;
};

/// Columns of a trixel of so many cells in the rows `from` to `to`, counted from its square's first row.
Span columns(int half, int cells, int from, int to) {
  return half == 0 ? Span{0, cells - from} : Span{cells - to, cells};
}

}  // namespace

std::vector<NodeRect> footprint(const Settings& settings, const Region& region, int d) {
  const NodeRect& around = region.nodes[static_cast<std::size_t>(d)];
  if (around.empty()) return {};
  if (settings.windows == Windows::kPlain || region.level == settings.base_level) return {around};
  const int rows = settings.strip_rows(), cells = settings.unit();
  std::map<int, Span> strips;  // by first row
  const auto add = [&](int row, int from, const Span& span) {
    const auto [strip, is_new] = strips.try_emplace(row, Span{from + span.first, from + span.last});
    if (is_new) return;
    strip->second.first = std::min(strip->second.first, from + span.first);
    strip->second.last = std::max(strip->second.last, from + span.last);
  };
  for (const LatticeTrixel& unit : region.units) {
    if (unit.d != d) continue;
    for (int row = 0; row < cells; row += rows)
      add(unit.j * cells + row, unit.i * cells, columns(unit.half, cells, row, row + rows - 1));
    add((unit.j + 1) * cells, unit.i * cells, columns(unit.half, cells, cells, cells));
  }
  std::vector<NodeRect> rects;
  rects.reserve(strips.size());
  for (const auto& [row, span] : strips)
    rects.push_back({span.first, span.last, row, std::min(row + rows - 1, around.j1)});
  return rects;
}

}  // namespace globe::clipmap
