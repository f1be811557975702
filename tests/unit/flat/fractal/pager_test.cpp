#include "flat/fractal/pager.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "flat/fractal/terrain.h"
#include "globe/base/error.h"
#include "globe/render/camera.h"

namespace globe::flat::fractal {
namespace {

Settings ground(Method method = Method::kDiamondSquare) {
  Settings settings;
  settings.method = method;
  settings.iterations = 8;
  return settings;
}

std::vector<float> made(BlockMaker& maker, const BlockKey& key) {
  std::vector<float> heights(static_cast<std::size_t>(maker.posts_with_rim() * maker.posts_with_rim()));
  maker.make(key, heights);
  return heights;
}

TEST(FractalBlocks, AreTheSameInAnyOrderWhateverIsCached) {
  for (const Method method : {Method::kDiamondSquare, Method::kSquareSquare}) {
    BlockMaker bare(ground(method), 3, 0), small(ground(method), 3, 1), usual(ground(method), 3, 8);
    std::mt19937 random(8);
    for (int trial = 0; trial < 400; ++trial) {
      const std::int64_t far = trial % 2 == 0 ? 0 : 10'000'000;
      const BlockKey key{far + static_cast<std::int64_t>(random() % 160) - 80,
                         static_cast<std::int64_t>(random() % 160) - 80 - far};
      const std::vector<float> truth = made(bare, key);
      ASSERT_EQ(made(small, key), truth);
      ASSERT_EQ(made(usual, key), truth);
    }
    EXPECT_EQ(bare.counts().hits + bare.counts().misses, 0u);
    EXPECT_GT(usual.counts().hits, small.counts().hits);
  }
}

TEST(FractalBlocks, NeighboursShareBordersAndRims) {
  BlockMaker maker(ground(), 4, 8);
  const int side = maker.posts_with_rim(), cells = maker.cells();
  const std::vector<float> west = made(maker, {-1, 5}), east = made(maker, {0, 5}),
                           north = made(maker, {-1, 6});
  const auto at = [&](const std::vector<float>& h, int column, int row) {
    return h[static_cast<std::size_t>(row * side + column)];
  };
  for (int k = 0; k < side; ++k) {
    for (int across = 0; across < 3; ++across) {
      EXPECT_EQ(at(west, cells + across, k), at(east, across, k));
      EXPECT_EQ(at(west, k, cells + across), at(north, k, across));
    }
  }
}

TEST(FractalBlocks, TheAreaUsedLongestAgoGoesFirst) {
  BlockMaker maker(ground(), 3, 2);
  const std::int64_t area = maker.blocks_per_area();
  made(maker, {0, 0});         // made: area A
  made(maker, {area, 0});      // made: B
  made(maker, {1, 1});         // there: A
  made(maker, {2 * area, 0});  // made: C, B goes
  made(maker, {3, 3});         // there: A
  made(maker, {area, 0});      // made: B again
  EXPECT_EQ(maker.counts().hits, 2u);
  EXPECT_EQ(maker.counts().misses, 4u);
  EXPECT_EQ(maker.counts().blocks, 6u);
}

TEST(FractalPager, OneStaysInABoxAQuarterWiderThanABlock) {
  EXPECT_EQ(steps_to_hold(10.624, 10, 0.25), 0);
  EXPECT_EQ(steps_to_hold(10.626, 10, 0.25), 1);
  EXPECT_EQ(steps_to_hold(9.376, 10, 0.25), 0);
  EXPECT_EQ(steps_to_hold(9.374, 10, 0.25), -1);
  // Having paged at 10.626 one may go back by a quarter of a block, and not farther.
  EXPECT_EQ(steps_to_hold(10.376, 11, 0.25), 0);
  EXPECT_EQ(steps_to_hold(10.374, 11, 0.25), -1);
  EXPECT_EQ(steps_to_hold(1e7 + 0.3, 10, 0.25), 9'999'990);
  for (double place = -30; place < 30; place += 0.0625) {
    const auto middle = static_cast<double>(steps_to_hold(place, 0, 0.25));
    EXPECT_LE(std::abs(place - middle), 0.625);
  }
}

TEST(FractalPager, WanderingAboutABorderPagesOnce) {
  const auto pagings = [](double slack) {
    Pager pager(ground(), {.log2_cells = 3, .log2_blocks = 3, .slack = slack});
    pager.move_to({0, 0});
    int count = 0;
    for (int step = 0; step < 100; ++step) count += pager.move_to({4.3 + (step % 2 == 0 ? -1.1 : 1.1), 0});
    return count;
  };
  EXPECT_EQ(pagings(0.25), 1);
  EXPECT_GT(pagings(0.0), 50);  // a box as wide as a block thrashes
}

TEST(FractalPager, OnlyRowsAheadAreMade) {
  Pager pager(ground(), {.log2_cells = 3, .log2_blocks = 4});
  const auto made_by_going = [&](const glm::dvec2& place) {
    const std::uint64_t before = pager.counts().blocks;
    pager.move_to(place);
    return pager.counts().blocks - before;
  };
  EXPECT_EQ(made_by_going({0, 0}), 256u);
  EXPECT_EQ(made_by_going({6, 0}), 16u);
  EXPECT_EQ(made_by_going({6, 1}), 0u);
  EXPECT_EQ(made_by_going({14, 8}), 31u);  // north-east: a row and a column
}

TEST(FractalPager, AfterAnyWalkTheSquareIsWhatItWouldBeMadeAnew) {
  std::mt19937 random(12);
  for (const Method method : {Method::kDiamondSquare, Method::kSquareSquare}) {
    const PagerSettings settings{.log2_cells = 3, .log2_blocks = 3};
    Pager walker(ground(method), settings);
    glm::dvec2 place(0.0);
    for (int step = 0; step < 120; ++step) {
      // Mostly small steps, now and then past the square and back, once 1e7 blocks off.
      const double reach = step % 10 == 9 ? 400.0 : 9.0;
      const auto part = [&] { return reach * (static_cast<double>(random() % 2001) / 1000.0 - 1.0); };
      place += glm::dvec2(part(), part());
      if (step == 60) place += glm::dvec2(8e7, -8e7);
      if (!walker.move_to(place)) continue;
      Pager fresh(ground(method), settings);
      fresh.move_to(glm::dvec2(walker.middle().x, walker.middle().y) * 8.0);
      ASSERT_EQ(fresh.middle(), walker.middle());
      const BlockKey first = walker.first();
      for (int k = 0; k < 64; ++k) {
        const int slot = walker.slot({first.x + k % 8, first.y + k / 8});
        const auto a = walker.heights(slot), b = fresh.heights(slot);
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
        ASSERT_EQ(walker.block(slot).key, fresh.block(slot).key);
        ASSERT_LE(walker.block(slot).lowest_m, walker.block(slot).highest_m);
      }
    }
    EXPECT_GT(walker.counts().moves, 60u);
    EXPECT_GT(walker.counts().hits, walker.counts().misses);
  }
}

TEST(FractalPager, SettingsOutsideTheirRangesAreRefused) {
  const auto refused = [](const PagerSettings& settings) {
    EXPECT_THROW(Pager(ground(), settings), UsageError);
  };
  refused({.log2_cells = 1});
  refused({.log2_cells = 7});
  refused({.log2_blocks = 1});
  refused({.log2_blocks = 9});
  refused({.log2_cells = 6, .log2_blocks = 7});
  refused({.slack = -0.1});
  refused({.slack = std::nan("")});
  refused({.cached_areas = -1});
}

TEST(FractalTerrain, DrawsFewerTrianglesByLevelsAndCullingAndAllWithoutEither) {
  TerrainSettings settings{.ground = ground(), .pager = {.log2_cells = 3, .log2_blocks = 5}, .rings = {}};
  const render::Camera camera{.forward = {0, 1, 0}, .right = {1, 0, 0}, .up = {0, 0, 1}, .aspect = 4.0 / 3.0};
  const glm::dmat4 clip = render::clip_from_relative(camera, 1.0);
  const auto triangles = [&](bool lod, bool culling) {
    settings.lod = lod;
    settings.culling = culling;
    Terrain terrain(settings);
    terrain.move_to({3, 4});
    std::size_t count = 0;
    for (const BlockDraw& draw : terrain.draws(clip, {3, 4, 2000}))
      count += block_triangles(8, draw.level, draw.edges).size() / 3;
    return count;
  };
  const std::size_t all = triangles(false, false), lod = triangles(true, false),
                    culled = triangles(false, true);
  const std::size_t both = triangles(true, true);
  EXPECT_EQ(all, 2u * 256 * 256);
  EXPECT_LT(lod, all / 3);
  EXPECT_LT(culled, all / 2);
  EXPECT_LT(both, lod);
  EXPECT_LT(both, culled);
  EXPECT_GT(both, 0u);
}

TEST(FractalTerrain, TellsTheHeightOfItsPosts) {
  TerrainSettings settings{.ground = ground(), .pager = {.log2_cells = 3, .log2_blocks = 3}, .rings = {}};
  Terrain terrain(settings);
  terrain.move_to({-300, 800});
  const FractalSource source(settings.ground);
  for (const auto& [i, j] : {std::pair{-300, 800}, std::pair{-303, 795}, std::pair{-288, 808}}) {
    std::array<float, 1> height{};
    source.posts({i, j, 1, 1, 1}, height);
    EXPECT_EQ(terrain.height_m({i, j}), static_cast<double>(height[0]));
  }
}

}  // namespace
}  // namespace globe::flat::fractal
