#include "globe/planet/directions.h"

#include <algorithm>
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

/// Walks down the levels: each holds what the one below needs, half as many a side.
Patch directions_between(int d, int level, ivec2 first, ivec2 last) {
  Patch patch(first, last);
  if (level == 0) {
    for (int j = first.y; j <= last.y; ++j)
      for (int i = first.x; i <= last.x; ++i) patch.at(i, j) = node_direction({d, 0, i, j});
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

TileValues<dvec3> node_directions(const TileId& id) {
  const int n = nodes_per_side(id.level);
  const ivec2 guarded_first{id.first_i() - kTileGuard, id.first_j() - kTileGuard};
  const ivec2 guarded_last{id.first_i() + id.cells() + kTileGuard, id.first_j() + id.cells() + kTileGuard};
  Patch patch =
      directions_between(id.d, id.level, {std::max(guarded_first.x, 0), std::max(guarded_first.y, 0)},
                         {std::min(guarded_last.x, n), std::min(guarded_last.y, n)});
  TileValues<dvec3> result(id);
  for (int j = guarded_first.y; j <= guarded_last.y; ++j) {
    for (int i = guarded_first.x; i <= guarded_last.x; ++i) {
      const bool inside = i >= 0 && j >= 0 && i <= n && j <= n;
      result.at(i, j) = inside ? patch.at(i, j) : node_direction(fold({id.d, id.level, i, j}));
    }
  }
  return result;
}

}  // namespace globe::planet
