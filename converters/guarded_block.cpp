#include "converters/guarded_block.h"

#include <algorithm>
#include <cstdlib>

namespace converters {
namespace {

using globe::planet::fold;
using globe::planet::ivec2;
using globe::planet::Node;
using globe::planet::nodes_per_side;

/// The guard nodes of a rectangle that lie beyond the diamond, line by line.
std::vector<ivec2> beyond_border(const NodeRect& rect) {
  const int n = nodes_per_side(rect.level);
  std::vector<ivec2> found;
  const auto add = [&](int i, int j) {
    const bool outside = i < 0 || j < 0 || i > n || j > n;
    const bool nobodys = (i < 0 && j < 0) || (i > n && j > n);
    if (outside && !nobodys) found.push_back({i, j});
  };
  for (const int i : {rect.i0 - 1, rect.i0 + rect.ni})
    for (int j = rect.j0 - 1; j <= rect.j0 + rect.nj; ++j) add(i, j);
  for (const int j : {rect.j0 - 1, rect.j0 + rect.nj})
    for (int i = rect.i0; i < rect.i0 + rect.ni; ++i) add(i, j);
  return found;
}

/// Nodes one after the other along a row or a column of a diamond.
struct Run {
  Node first;
  ivec2 step{0, 0};
  int count = 1;

  bool takes(const Node& next) const {
    const ivec2 move{next.i - first.i - (count - 1) * step.x, next.j - first.j - (count - 1) * step.y};
    return next.d == first.d && std::abs(move.x) + std::abs(move.y) == 1 && (count == 1 || move == step);
  }
  void add(const Node& next) {
    if (count == 1) step = {next.i - first.i, next.j - first.j};
    ++count;
  }
  NodeRect rect() const {
    const ivec2 last{first.i + (count - 1) * step.x, first.j + (count - 1) * step.y};
    return {first.d,
            first.level,
            std::min(first.i, last.x),
            std::min(first.j, last.y),
            std::abs(last.x - first.i) + 1,
            std::abs(last.y - first.j) + 1};
  }
  int index(int i, int j) const { return std::abs(i - first.i) + std::abs(j - first.j); }
};

}  // namespace

GuardedBlock::GuardedBlock(const NodeRect& rect, int channels, const NodeSource& nodes)
    : rect_(rect), channels_(channels) {
  values_.resize(static_cast<std::size_t>(stride()) * static_cast<std::size_t>(rect.nj + 2) *
                 static_cast<std::size_t>(channels_));
  const int n = nodes_per_side(rect.level);
  NodeRect inside = rect;
  inside.i0 = std::max(0, rect.i0 - 1);
  inside.j0 = std::max(0, rect.j0 - 1);
  inside.ni = std::min(n, rect.i0 + rect.ni) + 1 - inside.i0;
  inside.nj = std::min(n, rect.j0 + rect.nj) + 1 - inside.j0;
  const RowSink sink = [&](int i, int j, int count, const float* values, const float*) {
    std::copy_n(values, count * channels_, at(i, j));
  };
  nodes(inside, sink);
  take_beyond_border(nodes);
}

void GuardedBlock::take_beyond_border(const NodeSource& nodes) {
  const std::vector<ivec2> places = beyond_border(rect_);
  for (std::size_t k = 0; k < places.size();) {
    const std::size_t begin = k;
    const auto node = [&](std::size_t p) { return fold({rect_.d, rect_.level, places[p].x, places[p].y}); };
    Run run{node(k++)};
    for (; k < places.size() && run.takes(node(k)); ++k) run.add(node(k));
    const RowSink sink = [&](int i, int j, int count, const float* values, const float*) {
      for (int c = 0; c < count; ++c) {
        const ivec2& place = places[begin + static_cast<std::size_t>(run.index(i + c, j))];
        std::copy_n(values + c * channels_, channels_, at(place.x, place.y));
      }
    };
    nodes(run.rect(), sink);
  }
}

}  // namespace converters
