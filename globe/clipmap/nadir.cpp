#include "globe/clipmap/nadir.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace globe::clipmap {
namespace {

using planet::fold;
using planet::hex_length;
using planet::kDiamonds;
using planet::kMaxLevel;
using planet::octahedral_key;

/// Turns a point about the north pole's lattice point (0, 0) by 60 degrees, into the plane of diamond d from
/// that of d + 1 (steps = 1) or d - 1 (steps = -1).
LatticePoint turn(LatticePoint p, int steps) {
  for (; steps > 0; --steps) p = {-p.j, p.i + p.j};
  for (; steps < 0; ++steps) p = {p.i + p.j, -p.i};
  return p;
}

}  // namespace

GridPoint Nadir::at(int level) const {
  const double scale = std::ldexp(static_cast<double>(kSubcell), level - kMaxLevel);
  return {finest_.d, level, {std::llround(finest_.ij.x * scale), std::llround(finest_.ij.y * scale)}};
}

GridPoint grid_point(const Node& node) {
  return {node.d, node.level, {node.i * kSubcell, node.j * kSubcell}};
}

std::vector<LatticePoint> images(const GridPoint& point, int d) {
  const int turns = ((point.d - d) % kDiamonds + kDiamonds) % kDiamonds;
  if (turns == 0) return {point.at};
  const std::int64_t n = (std::int64_t{1} << point.level) * kSubcell;
  const LatticePoint from_south{n - point.at.i, n - point.at.j};
  std::vector<LatticePoint> result;
  const auto add = [&](int steps) {
    result.push_back(turn(point.at, steps));
    const LatticePoint s =
        turn(from_south, -steps);  // seen from the south pole the diamonds follow the other way round
    result.push_back({n - s.i, n - s.j});
  };
  if (turns != 3) add(turns);
  if (turns != 1) add(turns - kDiamonds);
  return result;
}

std::int64_t hex_distance(const std::vector<LatticePoint>& images, LatticePoint p) {
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  for (const LatticePoint& image : images)
    nearest = std::min(nearest, hex_length(p.i - image.i, p.j - image.j));
  return nearest;
}

Node nearest_lattice_node(const GridPoint& point, int step) {
  const std::int64_t unit = step * kSubcell;
  const auto i0 = static_cast<int>(point.at.i / unit) * step;
  const auto j0 = static_cast<int>(point.at.j / unit) * step;
  const int n = planet::nodes_per_side(point.level);
  std::optional<std::tuple<std::int64_t, int, int, int>> best;
  Node nearest;
  for (const ivec2 ij :
       {ivec2{i0, j0}, ivec2{i0 + step, j0}, ivec2{i0, j0 + step}, ivec2{i0 + step, j0 + step}}) {
    if (ij.x > n || ij.y > n) continue;
    const Node node{point.d, point.level, ij.x, ij.y};
    const auto key = octahedral_key(node);
    const std::int64_t distance = hex_length(ij.x * kSubcell - point.at.i, ij.y * kSubcell - point.at.j);
    const std::tuple candidate{distance, key.x, key.y, key.z};
    if (!best || candidate < *best) {
      best = candidate;
      nearest = node;
    }
  }
  // The same vertex has a name in every diamond that holds it; take the one of the least diamond.
  const planet::Names all = planet::names(nearest);
  return *std::min_element(all.node.begin(), all.node.begin() + all.count, [](const Node& a, const Node& b) {
    return std::tie(a.d, a.i, a.j) < std::tie(b.d, b.i, b.j);
  });
}

}  // namespace globe::clipmap
