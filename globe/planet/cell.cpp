#include "globe/planet/cell.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <glm/vec2.hpp>

#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

using IntCorners = std::array<ivec2, 3>;

/// Grid corners of the level-0 trixels, in the order of their HTM corners: S(d) is west, south pole, east;
/// N(3 - d) is east, north pole, west.
IntCorners root_corners(bool north, int n) {
  const ivec2 west{n, 0};
  const ivec2 east{0, n};
  if (north) return {east, {0, 0}, west};
  return {west, {n, n}, east};
}

IntCorners child_corners(const IntCorners& c, std::size_t k) {
  const auto half = [&](std::size_t a, std::size_t b) { return (c[a % 3] + c[b % 3]) / 2; };
  if (k == 3) return {half(1, 2), half(2, 0), half(0, 1)};
  return {c[k], half(k, k + 1), half(k + 2, k)};
}

}  // namespace

Cell cell_from_trixel(htm::Trixel trixel) {
  const int level = htm::level(trixel);
  const auto root = static_cast<int>(trixel.id >> (2 * level)) - static_cast<int>(htm::kFirstRoot);
  const bool north = root >= kDiamonds;
  IntCorners c = root_corners(north, nodes_per_side(level));
  for (int below = level - 1; below >= 0; --below) c = child_corners(c, trixel.id >> (2 * below) & 3);
  const int i = std::min({c[0].x, c[1].x, c[2].x});
  const int j = std::min({c[0].y, c[1].y, c[2].y});
  const bool holds_ij = std::find(c.begin(), c.end(), ivec2{i, j}) != c.end();
  return {north ? 7 - root : root, level, i, j, holds_ij ? 0 : 1};
}

htm::Trixel trixel_from_cell(const Cell& cell) {
  const auto [d, level, i, j, half] = cell;
  const std::int64_t n = nodes_per_side(level);
  assert(level >= 0 && level <= htm::kMaxLevel && d >= 0 && d < kDiamonds && (half == 0 || half == 1));
  assert(i >= 0 && i < n && j >= 0 && j < n);
  // Barycentric weights of the trixel's centre in the root, in thirds of a cell; their sum stays 3n all the
  // way.
  const std::int64_t ci = 3 * std::int64_t{i} + 1 + half;
  const std::int64_t cj = 3 * std::int64_t{j} + 1 + half;
  const std::int64_t total = 3 * n;
  const bool north = ci + cj < total;
  std::array<std::int64_t, 3> w{cj, total - ci - cj, ci};
  if (!north) w = {total - cj, ci + cj - total, total - ci};
  std::uint64_t id = htm::kFirstRoot + static_cast<std::uint64_t>(north ? 7 - d : d);
  for (int step = 0; step < level; ++step) {
    std::size_t k = 0;
    while (k < 3 && 2 * w[k] < total) ++k;
    if (k == 3) {
      w = {total - 2 * w[0], total - 2 * w[1], total - 2 * w[2]};
    } else {
      w = {2 * w[k] - total, 2 * w[(k + 1) % 3], 2 * w[(k + 2) % 3]};
    }
    id = id << 2 | k;
  }
  return {id};
}

}  // namespace globe::planet
