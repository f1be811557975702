#include "flat/fractal/mesh.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "flat/cell.h"
#include "globe/base/error.h"

namespace globe::flat::fractal {

std::vector<std::uint16_t> block_triangles(int cells, int level, unsigned edges) {
  const int side = cells >> level;
  assert(side >= 1 && (edges == 0 || level < kLevels - 1));
  const auto post = [&](int column, int row) {
    const bool on_row = (row == 0 && (edges & kSouth)) || (row == side && (edges & kNorth));
    const bool on_column = (column == 0 && (edges & kWest)) || (column == side && (edges & kEast));
    if (on_row) column &= ~1;
    if (on_column) row &= ~1;
    return static_cast<std::uint16_t>(((row << level) * (cells + 1)) + (column << level));
  };
  std::vector<std::uint16_t> triangles;
  const auto add = [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      // Diagonals take turns, so that no direction stands out.
      split_cell((column + row) % 2 == 0, post(column, row), post(column + 1, row), post(column, row + 1),
                 post(column + 1, row + 1), add);
    }
  }
  return triangles;
}

void check(const Rings& rings) {
  if (rings.fine >= 0.0 && rings.medium - rings.fine >= std::numbers::sqrt2 && rings.medium < 1e9) return;
  throw UsageError(
      "rings of " + std::to_string(rings.fine) + " and " + std::to_string(rings.medium) + " blocks",
      "the second must lie a block's diagonal, 1.4142 blocks, beyond the first",
      "give radii such as 4 and 9");
}

int level_of(const Rings& rings, int blocks, int column, int row) {
  const double x = column + 0.5 - 0.5 * blocks;
  const double y = row + 0.5 - 0.5 * blocks;
  const double square = x * x + y * y;
  return square < rings.fine * rings.fine ? 0 : square < rings.medium * rings.medium ? 1 : 2;
}

unsigned coarser_edges(std::span<const std::uint8_t> levels, int blocks, int column, int row) {
  const auto level = [&](int x, int y) { return levels[static_cast<std::size_t>(y * blocks + x)]; };
  const int own = level(column, row);
  unsigned edges = 0;
  if (column > 0 && level(column - 1, row) > own) edges |= kWest;
  if (column + 1 < blocks && level(column + 1, row) > own) edges |= kEast;
  if (row > 0 && level(column, row - 1) > own) edges |= kSouth;
  if (row + 1 < blocks && level(column, row + 1) > own) edges |= kNorth;
  return edges;
}

}  // namespace globe::flat::fractal
