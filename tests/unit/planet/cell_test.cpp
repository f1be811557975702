#include "globe/planet/cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

/// The cell's three nodes are the trixel's three corners, bit for bit.
void expect_corners_fit(const Cell& cell) {
  const auto direction = [&](int i, int j) { return node_direction({cell.d, cell.level, i, j}); };
  const auto [d, level, i, j, half] = cell;
  const std::array<dvec3, 3> nodes{half == 0 ? direction(i, j) : direction(i + 1, j + 1), direction(i + 1, j),
                                   direction(i, j + 1)};
  const htm::Corners corners = htm::corners(trixel_from_cell(cell));
  EXPECT_TRUE(std::is_permutation(nodes.begin(), nodes.end(), corners.begin()))
      << "d " << d << " level " << level << " i " << i << " j " << j << " half " << half;
}

TEST(Cell, IsATrixelOneForOneToLevel6) {
  for (int level = 0; level <= 6; ++level) {
    std::set<std::uint64_t> ids;
    const int n = nodes_per_side(level);
    for (int d = 0; d < kDiamonds; ++d)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          for (int half = 0; half < 2; ++half) {
            const Cell cell{d, level, i, j, half};
            const htm::Trixel t = trixel_from_cell(cell);
            ASSERT_EQ(htm::level(t), level);
            ASSERT_EQ(cell_from_trixel(t), cell);
            ids.insert(t.id);
            if (level <= 4) expect_corners_fit(cell);
          }
    EXPECT_EQ(ids.size(), 8u << (2 * level));
  }
}

TEST(Cell, HasTheCornersOfItsTrixelAtEveryLevel) {
  std::mt19937_64 random(21);
  for (int level = 0; level <= htm::kMaxLevel; ++level) {
    const auto n = static_cast<std::uint64_t>(nodes_per_side(level));
    for (int trial = 0; trial < 100; ++trial) {
      const Cell cell{static_cast<int>(random() % 4), level, static_cast<int>(random() % n),
                      static_cast<int>(random() % n), static_cast<int>(random() % 2)};
      ASSERT_EQ(cell_from_trixel(trixel_from_cell(cell)), cell);
      expect_corners_fit(cell);
    }
  }
}

TEST(Cell, DiamondIsTheQuarterOfLongitudesThatStartsAt90D) {
  EXPECT_EQ(cell_from_trixel({15}), (Cell{0, 0, 0, 0, 0}));  // N3
  EXPECT_EQ(cell_from_trixel({8}), (Cell{0, 0, 0, 0, 1}));   // S0
  EXPECT_EQ(cell_from_trixel({12}), (Cell{3, 0, 0, 0, 0}));  // N0
  EXPECT_EQ(cell_from_trixel({11}), (Cell{3, 0, 0, 0, 1}));  // S3
}

}  // namespace
}  // namespace globe::planet
