#include "converters/block_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "converters/layer_output.h"
#include "converters/srgb.h"
#include "globe/planet/mean_height.h"
#include "tests/temporary_folder.h"
#include "tests/unit/converters/test_maps.h"

// Jobs see a strip of a diamond each; what they leave together must be what the whole level gives.

namespace converters {
namespace {

using globe::geo::kWgs84;
using globe::planet::nodes_per_side;
using test::for_each_node;
using test::geometry_of;
using test::plenty;

double rough(double lat, double lon) {
  const double x = std::sin(lat * 127.1 + lon * 311.7) * 43758.5453;
  return 1000.0 * (x - std::floor(x)) - 300.0;
}

/// All jobs of a level done, and the same level sampled whole.
struct Done {
  MemoryBudget budget = plenty();
  tests::TemporaryFolder folder;
  PartFiles files{folder.path()};
  Filter filter;
  SourceMap map;
  Range range{1e9, -1e9};

  Done(int level, Filter chosen, SourceMap source) : filter(chosen), map(std::move(source)) {
    const JobLayer layer = map.channels() == 1 ? JobLayer::kHeight : JobLayer::kColor;
    std::vector<Job> jobs = jobs_of(layer, level);
    std::reverse(jobs.begin(), jobs.end());  // their order is nobody's business
    for (const Job& job : jobs) {
      const NodeSource nodes = [&](const NodeRect& rect, const RowSink& sink) {
        sample_nodes(test::stack_of({&map}, filter), rect, Gaps::kFill, sink, [](double) {});
      };
      const Range part = run_job(job, nodes, kWgs84, files, [](double) {});
      range = {std::min(range.min, part.min), std::max(range.max, part.max)};
    }
  }
  NodeGrid<float> whole(int level) { return test::sample(map, filter, level, budget); }
};

SourceMap rough_map(int width) {
  static MemoryBudget budget = plenty();
  return test::height_map(geometry_of(width, width / 2), rough, budget);
}

int differences(const NodeGrid<float>& a, const NodeGrid<float>& b) {
  int found = 0;
  for_each_node(a, [&](const globe::planet::Node& node, float) {
    for (int c = 0; c < a.channels(); ++c)
      found += a.at(node.d, node.i, node.j)[c] != b.at(node.d, node.i, node.j)[c];
  });
  return found;
}

TEST(Job, CoversEveryNodeOfALevelOnce) {
  for (const int level : {0, 1, 6, 7, 8, 11, 14, 15, 18}) {
    const int n = nodes_per_side(level);
    int next = 0, d = 0;
    for (const Job& job : jobs_of(JobLayer::kHeight, level)) {
      const NodeRect rect = nodes_of(job);
      if (job.d != d) {
        EXPECT_EQ(next, n + 1);
        d = job.d;
        next = 0;
      }
      EXPECT_EQ(rect.j0, next);
      EXPECT_EQ(rect.ni, n + 1);
      EXPECT_TRUE(level < 7 || rect.j0 % kTileSize == 0);
      next += rect.nj;
    }
    EXPECT_EQ(d, 3);
    EXPECT_EQ(next, n + 1);
  }
}

TEST(BlockRow, LeavesTheNextLevelOfHeightsThatTheWholeGives) {
  for (const int level : {1, 3, 8, 9, 12}) {
    Done done(level, level == 12 ? Filter::kNearest : Filter::kArea, rough_map(300));
    const NodeGrid<float> whole = done.whole(level);
    NodeGrid<float> coarse(level - 1, 1, done.budget);
    subsample(whole, coarse);
    const NodeGrid<float> heights(level - 1, 1, done.files.level("height"));
    EXPECT_EQ(differences(heights, coarse), 0) << level;
    filter(whole, coarse);
    const NodeGrid<float> relief(level - 1, 1, done.files.level("relief"));
    EXPECT_EQ(differences(relief, coarse), 0) << level;
    EXPECT_EQ(test::broken_edges(relief), 0);
  }
}

TEST(BlockRow, LeavesTheRangeAndTheMeansOfEveryCell) {
  for (const int level : {0, 2, 3, 8, 9}) {
    Done done(level, Filter::kBilinear, rough_map(300));
    const NodeGrid<float> whole = done.whole(level);
    const int block_level = globe::planet::block_level(level);
    const int cells = 1 << (level - block_level);
    const NodeGrid<float> ranges(block_level, 2, done.files.level("height_range"));
    const NodeGrid<float> means(block_level, 2, done.files.level("height_mean"));
    for_each_node(ranges, [&](const globe::planet::Node& node, float) {
      const int i = std::min(node.i, nodes_per_side(block_level) - 1);
      const int j = std::min(node.j, nodes_per_side(block_level) - 1);
      globe::planet::HeightBlock block;
      block.d = node.d;
      block.height_level = level;
      block.i0 = i * cells;
      block.j0 = j * cells;
      float low = 1e9F, high = -1e9F;
      for (int y = block.j0; y <= block.j0 + cells; ++y) {
        for (int x = block.i0; x <= block.i0 + cells; ++x) {
          const float h = *whole.at(node.d, x, y);
          low = std::min(low, h);
          high = std::max(high, h);
          block.at(x, y) = static_cast<double>(h);
        }
      }
      ASSERT_EQ(ranges.at(node.d, node.i, node.j)[0], low);
      ASSERT_EQ(ranges.at(node.d, node.i, node.j)[1], high);
      for (const int half : {0, 1}) {
        const auto t = globe::planet::lattice_trixel(node.d, block_level, i, j, half);
        const double mean = globe::planet::mean_height(kWgs84, block, t, corners(t));
        ASSERT_EQ(means.at(node.d, node.i, node.j)[half], static_cast<float>(mean));
      }
    });
  }
}

TEST(BlockRow, KnowsTheRangeOfItsValues) {
  Done done(8, Filter::kNearest, rough_map(600));
  float low = 1e9F, high = -1e9F;
  for_each_node(done.whole(8), [&](const globe::planet::Node&, float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  });
  EXPECT_EQ(done.range.min, static_cast<double>(low));
  EXPECT_EQ(done.range.max, static_cast<double>(high));
}

TEST(HeightLayers, HoldTheLowestAndHighestSampleOfEveryCellAtEveryLevel) {
  constexpr int kLevel = 6;
  Done done(kLevel, Filter::kBilinear, rough_map(300));
  const NodeGrid<float> whole = done.whole(kLevel);
  const std::vector<LayerOutput> layers = height_layers(kLevel, done.range, done.files, kWgs84, done.budget);
  const LayerOutput& ranges = layers.at(2);
  ASSERT_EQ(ranges.stored.info.name, "height_range");
  ASSERT_EQ(ranges.stored.info.level, kLevel - 3);
  ASSERT_EQ(ranges.values.size(), 4U);
  for (const NodeGrid<float>& grid : ranges.values) {
    const int cells = 1 << (kLevel - grid.level());
    for_each_node(grid, [&](const globe::planet::Node& node, float) {
      const int i0 = std::min(node.i, grid.side() - 2) * cells;
      const int j0 = std::min(node.j, grid.side() - 2) * cells;
      float low = 1e9F, high = -1e9F;
      for (int y = j0; y <= j0 + cells; ++y) {
        for (int x = i0; x <= i0 + cells; ++x) {
          low = std::min(low, *whole.at(node.d, x, y));
          high = std::max(high, *whole.at(node.d, x, y));
        }
      }
      ASSERT_EQ(grid.at(node.d, node.i, node.j)[0], low);
      ASSERT_EQ(grid.at(node.d, node.i, node.j)[1], high);
    });
  }
}

TEST(ColorLayer, AveragesInLinearLight) {
  // Black and white columns in equal shares: half the light is byte 188, not 128.
  static MemoryBudget budget = plenty();
  test::FunctionRaster raster(600, 300, 3, SampleType::kUint8,
                              [](int x, int, int) { return x % 2 == 0 ? 255.0 : 0.0; });
  ValueRule rule;
  rule.kind = MapKind::kColors;
  Done done(8, Filter::kNearest, SourceMap(raster, geometry_of(600, 300), rule, 1, budget, [](double) {}));
  const LayerOutput layer = color_layer(8, done.files, done.budget);
  ASSERT_EQ(layer.bytes.size(), 8U);
  double light = 0;
  const NodeGrid<std::uint8_t>& coarse = layer.bytes[4];
  for (int d = 0; d < 4; ++d)
    for (int j = 0; j < coarse.side(); ++j)
      for (int i = 0; i < coarse.side(); ++i)
        light += static_cast<double>(linear_from_srgb_bytes()[coarse.at(d, i, j)[1]]);
  EXPECT_NEAR(light / (4 * coarse.side() * coarse.side()), 0.5, 0.02);
  EXPECT_NEAR(coarse.at(1, 5, 3)[0], 188, 25);
}

TEST(ColorLayer, FiltersWhatIsStoredAndReachesAcrossBorders) {
  static MemoryBudget budget = plenty();
  test::FunctionRaster raster(600, 300, 3, SampleType::kUint8, [](int x, int y, int c) {
    return std::floor(127.5 + 127.0 * std::sin(x * 12.9898 + y * 78.233 + c));
  });
  ValueRule rule;
  rule.kind = MapKind::kColors;
  Done done(8, Filter::kBilinear, SourceMap(raster, geometry_of(600, 300), rule, 1, budget, [](double) {}));
  NodeGrid<float> whole = done.whole(8);
  for_each_node(whole, [&](const globe::planet::Node& node, float) {
    float* value = whole.at(node.d, node.i, node.j);
    for (int c = 0; c < 3; ++c) value[c] = linear_from_srgb_bytes()[srgb_byte_from_linear(value[c])];
  });
  NodeGrid<float> coarse(7, 3, done.budget);
  filter(whole, coarse);
  EXPECT_EQ(differences(NodeGrid<float>(7, 3, done.files.level("color")), coarse), 0);
}

}  // namespace
}  // namespace converters
