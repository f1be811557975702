#include "globe/planet/cell.h"

#include <array>
#include <cassert>
#include <cstdint>

#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

/// What share of each corner of its root a trixel holds, in cells and rounded down: the binary digits that
/// htm/descent.h makes ids of. Their sum is n - 1 the way up that the root has, n - 2 upside down.
struct Shares {
  std::array<std::uint32_t, 3> of_corner;
  bool upside_down;
};

Shares shares_of(htm::Trixel trixel, int level) {
  constexpr std::array<std::array<std::uint32_t, 4>, 3> kLabelAfter{
      {{0, 1, 2, 0}, {1, 2, 0, 1}, {2, 0, 1, 2}}};
  Shares shares{};
  std::uint32_t label = 0, flip = 0;
  for (int below = level - 1; below >= 0; --below) {
    const std::size_t digit = trixel.id >> (2 * below) & 3;
    const std::uint32_t corner_child = digit != 3;
    label = kLabelAfter[label][digit];
    for (std::uint32_t k = 0; k < 3; ++k)
      shares.of_corner[k] = shares.of_corner[k] << 1 | (((k == label) & corner_child) ^ flip);
    flip ^= 1 ^ corner_child;
  }
  shares.upside_down = flip != 0;
  return shares;
}

}  // namespace

Cell cell_from_trixel(htm::Trixel trixel) {
  const int level = htm::level(trixel);
  const auto root = static_cast<int>(trixel.id >> (2 * level)) - static_cast<int>(htm::kFirstRoot);
  const bool north = root >= kDiamonds;
  const Shares shares = shares_of(trixel, level);
  // N(3 - d) is east, north pole, west; S(d) is west, south pole, east (grid corners (0, n) and (n, 0)).
  const auto first = static_cast<int>(shares.of_corner[0]), last = static_cast<int>(shares.of_corner[2]);
  if (north) return {7 - root, level, last, first, shares.upside_down ? 1 : 0};
  const int n = nodes_per_side(level);
  return {root, level, n - 1 - last, n - 1 - first, shares.upside_down ? 0 : 1};
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
