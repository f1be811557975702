#include "globe/planet/directions.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "globe/htm/midpoint.h"

namespace globe::planet {
namespace {

/// Directions of a rectangle of a diamond's own nodes.
struct Patch {
  ivec2 first, last;
  std::vector<dvec3> u;

  Patch(ivec2 from, ivec2 to)
      : first(from),
        last(to),
        u(static_cast<std::size_t>(to.x - from.x + 1) * static_cast<std::size_t>(to.y - from.y + 1)) {}

  dvec3& at(int i, int j) {
    return u[static_cast<std::size_t>(j - first.y) * static_cast<std::size_t>(last.x - first.x + 1) +
             static_cast<std::size_t>(i - first.x)];
  }
};

constexpr std::size_t kFew = 16;  ///< so many nodes are walked to one by one

/// Walks up the levels: each holds what the one below needs, half as many a side.
Patch directions_between(int d, int level, ivec2 first, ivec2 last) {
  Patch patch(first, last);
  if (level == 0 || patch.u.size() <= kFew) {
    for (int j = first.y; j <= last.y; ++j)
      for (int i = first.x; i <= last.x; ++i) patch.at(i, j) = node_direction({d, level, i, j});
    return patch;
  }
  const int n = nodes_per_side(level - 1);
  const auto up = [n](ivec2 p) { return ivec2{std::min((p.x + 1) / 2, n), std::min((p.y + 1) / 2, n)}; };
  Patch coarse = directions_between(d, level - 1, first / 2, up(last));
  for (int j = first.y; j <= last.y; ++j) {
    for (int i = first.x; i <= last.x; ++i) {
      if (((i | j) & 1) == 0) {
        patch.at(i, j) = coarse.at(i / 2, j / 2);
      } else {
        const auto [a, b] = halved_edge(i, j);
        patch.at(i, j) = htm::midpoint(coarse.at(a.x / 2, a.y / 2), coarse.at(b.x / 2, b.y / 2));
      }
    }
  }
  return patch;
}

}  // namespace

TileValues<dvec3> node_directions(const TileId& id, int guard) {
  const int n = nodes_per_side(id.level);
  const ivec2 first{id.first_i() - guard, id.first_j() - guard};
  const ivec2 last{id.first_i() + id.cells() + guard, id.first_j() + id.cells() + guard};
  const ivec2 own_first{std::max(first.x, 0), std::max(first.y, 0)};
  const ivec2 own_last{std::min(last.x, n), std::min(last.y, n)};
  Patch patch = directions_between(id.d, id.level, own_first, own_last);
  TileValues<dvec3> result(id, dvec3(0.0), guard);
  if (patch.u.size() == result.values.size()) {
    result.values = std::move(patch.u);
    return result;
  }
  for_each_node(id, guard, [&](int i, int j, const Node& node) {
    const bool own = i >= 0 && j >= 0 && i <= n && j <= n;
    result.at(i, j) = own ? patch.at(i, j) : node_direction(node);
  });
  return result;
}

std::vector<dvec3> node_directions(int d, int level, const ivec2& first, const ivec2& last) {
  return directions_between(d, level, first, last).u;
}

}  // namespace globe::planet
