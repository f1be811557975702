#include "converters/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "converters/srgb.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

using globe::planet::Node;
using test::for_each_node;
using test::plenty;

/// A level whose values depend on the vertex alone.
NodeGrid<float> hashed(int level, int channels, MemoryBudget& budget) {
  NodeGrid<float> grid(level, channels, budget);
  for (int d = 0; d < 4; ++d) {
    for (int j = 0; j < grid.side(); ++j) {
      for (int i = 0; i < grid.side(); ++i) {
        for (int c = 0; c < channels; ++c) {
          const auto seed = static_cast<std::uint64_t>(c);
          const auto hash = globe::planet::vertex_hash(seed, globe::planet::octahedral_key({d, level, i, j}));
          grid.at(d, i, j)[c] = static_cast<float>(hash >> 40) / static_cast<float>(1 << 24);
        }
      }
    }
  }
  return grid;
}

TEST(Srgb, EveryByteSurvivesTheWayToLinearLightAndBack) {
  for (int byte = 0; byte < 256; ++byte)
    EXPECT_EQ(srgb_byte_from_linear(static_cast<float>(linear_from_srgb(byte / 255.0))), byte);
  EXPECT_EQ(srgb_byte_from_linear(-1.0F), 0);
  EXPECT_EQ(srgb_byte_from_linear(2.0F), 255);
  EXPECT_EQ(srgb_byte_from_linear(std::nanf("")), 0);
}

TEST(Srgb, TakesTheNearestByte) {
  for (int k = 0; k <= 100000; ++k) {
    const double linear = k / 100000.0;
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    ASSERT_NEAR(srgb_byte_from_linear(static_cast<float>(linear)), encoded * 255.0, 0.5001) << linear;
  }
}

TEST(Subsample, MakesEveryCoarseSampleAFineSample) {
  MemoryBudget budget = plenty();
  const NodeGrid<float> fine = hashed(5, 1, budget);
  NodeGrid<float> coarse(4, 1, budget);
  subsample(fine, coarse);
  for_each_node(coarse, [&](const Node& node, float value) {
    ASSERT_EQ(value, *fine.at(node.d, 2 * node.i, 2 * node.j));
  });
}

TEST(Filter, KeepsConstantsAndSharedNodes) {
  MemoryBudget budget = plenty();
  for (int level = 1; level <= 6; ++level) {
    NodeGrid<float> coarse(level - 1, 1, budget);
    filter(hashed(level, 1, budget), coarse);
    EXPECT_EQ(test::broken_edges(coarse), 0) << level;
    NodeGrid<float> flat(level, 1, budget);
    for_each_node(flat, [&](const Node& node, float) { *flat.at(node.d, node.i, node.j) = 3.25F; });
    filter(flat, coarse);
    for_each_node(coarse, [&](const Node&, float value) { ASSERT_EQ(value, 3.25F); });
  }
}

TEST(Filter, SpreadsOneSampleOverTheHatOfItsNeighbours) {
  MemoryBudget budget = plenty();
  NodeGrid<float> fine(4, 1, budget);
  *fine.at(1, 6, 4) = 8.0F;   // a node of the coarse level, too
  *fine.at(2, 7, 4) = 16.0F;  // halves the edge between (3, 2) and (4, 2)
  NodeGrid<float> coarse(3, 1, budget);
  filter(fine, coarse);
  EXPECT_EQ(*coarse.at(1, 3, 2), 2.0F);
  EXPECT_EQ(*coarse.at(1, 4, 2), 0.0F);
  EXPECT_EQ(*coarse.at(2, 3, 2), 2.0F);
  EXPECT_EQ(*coarse.at(2, 4, 2), 2.0F);
  EXPECT_EQ(*coarse.at(2, 3, 3), 0.0F);
}

TEST(Filter, ReachesAcrossTheBordersOfDiamonds) {
  MemoryBudget budget = plenty();
  NodeGrid<float> fine(3, 1, budget);
  *fine.at(1, 1, 4) = 8.0F;  // one step inside diamond 1 from its border (0, 4), which is (4, 0) of diamond 2
  NodeGrid<float> coarse(2, 1, budget);
  filter(fine, coarse);
  EXPECT_EQ(*coarse.at(1, 0, 2), 1.0F);
  EXPECT_EQ(*coarse.at(2, 2, 0), 1.0F);
}

}  // namespace
}  // namespace converters
