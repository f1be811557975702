#include "flat/fractal/morph.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "flat/fractal/pager.h"

namespace globe::flat::fractal {
namespace {

/// Where a coarser level's triangles have the ground over a post, as a mean of two posts.
std::array<std::array<int, 2>, 2> between(int cells, int level, int column, int row) {
  const std::vector<std::uint16_t> triangles = block_triangles(cells, level, 0);
  for (std::size_t k = 0; k < triangles.size(); k += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = triangles[k + c], b = triangles[k + (c + 1) % 3];
      const std::array<int, 2> p{a % (cells + 1), a / (cells + 1)}, q{b % (cells + 1), b / (cells + 1)};
      if (p[0] + q[0] == 2 * column && p[1] + q[1] == 2 * row) return {std::min(p, q), std::max(p, q)};
    }
  }
  return {};
}

TEST(FractalMorph, APostGoesToTheEdgeOfTheCoarserMeshThatItLiesOn) {
  for (const int cells : {4, 8, 16}) {
    for (int row = 0; row <= cells; ++row) {
      for (int column = 0; column <= cells; ++column) {
        const int level = last_level(column, row);
        if (level == kLevels - 1) continue;
        const Ends ends = ends_of(column, row);
        std::array<std::array<int, 2>, 2> gone{
            {{column - ends.columns, row - ends.rows}, {column + ends.columns, row + ends.rows}}};
        if (gone[1] < gone[0]) std::swap(gone[0], gone[1]);
        EXPECT_EQ(gone, between(cells, level + 1, column, row)) << cells << ": " << column << ',' << row;
      }
    }
  }
}

/// Whatever a viewer does in the box, a vertex of a block that is about to change has gone all the way, and
/// one that the finer level's blocks hold has not begun on the next.
TEST(FractalMorph, ALevelIsWhollyTheNextOneWhereARingMayChange) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kSlack = 0.25;
  constexpr int kBlocks = 32;
  const Rings rings{4.0, 9.0};
  const MorphBands bands = morph_bands(rings, kSlack, true);
  for (int trial = 0; trial < 20000; ++trial) {
    const double reach = 0.5 + 0.5 * kSlack, x = reach * unit(random), y = reach * unit(random);
    const int column = static_cast<int>(16 + 14 * unit(random)),
              row = static_cast<int>(16 + 14 * unit(random));
    const double u = column + 0.5 + 0.5 * unit(random) - 0.5 * kBlocks,
                 v = row + 0.5 + 0.5 * unit(random) - 0.5 * kBlocks;
    const auto away = static_cast<float>(std::hypot(u - x, v - y));
    const int level = level_of(rings, kBlocks, column, row);
    if (level > 0) {
      EXPECT_EQ(morph_share(bands, level - 1, away), 1.0f);
    }
    if (level == 0) {
      EXPECT_EQ(morph_share(bands, 1, away), 0.0f);
    }
  }
  EXPECT_EQ(morph_share(bands, 0, 0.5f), 0.0f);
}

TEST(FractalMorph, RingsTooNarrowChangeAtOnce) {
  EXPECT_EQ(morph_share(morph_bands({1.5, 9.0}, 0.25, true), 0, 100.0f), 0.0f);
  EXPECT_EQ(morph_share(morph_bands({4.0, 6.0}, 0.25, true), 1, 100.0f), 0.0f);
  EXPECT_EQ(morph_share(morph_bands({4.0, 9.0}, 0.25, false), 0, 100.0f), 0.0f);
}

}  // namespace
}  // namespace globe::flat::fractal
