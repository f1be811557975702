#include "converters/sampler.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "converters/footprint.h"
#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::degrees_from_normal;
using globe::geo::Geodetic;
using globe::planet::Node;
using globe::planet::node_direction;
using globe::planet::nodes_per_side;
using test::broken_edges;
using test::for_each_node;
using test::geometry_of;
using test::height_map;
using test::kAllFilters;
using test::plenty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double cos_cos(double lat, double lon) { return std::cos(lat * kDegree) * std::cos(lon * kDegree); }

double random_value(double lat, double lon) {
  const double x = std::sin(lat * 127.1 + lon * 311.7) * 43758.5453;
  return 1000.0 * (x - std::floor(x)) - 300.0;
}

double largest_error(const NodeGrid<float>& grid, const std::function<double(double, double)>& truth) {
  double error = 0;
  for_each_node(grid, [&](const Node& node, float value) {
    const Geodetic at = degrees_from_normal(node_direction(node));
    error = std::max(error, std::abs(static_cast<double>(value) - truth(at.lat_deg, at.lon_deg)));
  });
  return error;
}

TEST(SampleNodes, KeepsAConstantWhateverTheFilterAndSize) {
  MemoryBudget budget = plenty();
  for (const int width : {4, 64, 600}) {
    const SourceMap map = height_map(
        geometry_of(width, width / 2), [](double, double) { return 42.5; }, budget);
    for (const Filter filter : kAllFilters) {
      for (const int level : {0, 1, 4, 7}) {
        const NodeGrid<float> grid = test::sample(map, filter, level, budget);
        EXPECT_LE(largest_error(grid, [](double, double) { return 42.5; }), 1e-5)
            << width << " at level " << level;
      }
    }
  }
}

// cos(lat) cos(lon) has second derivatives of at most 1 a radian squared: linear joining errs by at most
// step^2/8 in each of the two directions; a bicubic by far less; a mean over a cell of radius r by r^2/4 a
// direction.
TEST(SampleNodes, FollowsASmoothFunctionWithinTheErrorOfTheFilter) {
  MemoryBudget budget = plenty();
  const MapGeometry geometry = geometry_of(720, 360);
  const SourceMap map = height_map(geometry, cos_cos, budget);
  const double step = geometry.step_deg * kDegree;
  for (const int level : {0, 3, 8}) {
    EXPECT_LE(largest_error(test::sample(map, Filter::kNearest, level, budget), cos_cos), step * 0.75)
        << level;
    EXPECT_LE(largest_error(test::sample(map, Filter::kBilinear, level, budget), cos_cos),
              step * step / 4 + 1e-7)
        << level;
    EXPECT_LE(largest_error(test::sample(map, Filter::kBicubic, level, budget), cos_cos),
              step * step / 4 + 1e-7)
        << level;
  }
  for (const int level : {4, 6, 9}) {
    const double cell = 0.5 * std::numbers::pi / nodes_per_side(level);
    for_each_node(test::sample(map, Filter::kArea, level, budget), [&](const Node& node, float value) {
      const Geodetic at = degrees_from_normal(node_direction(node));
      // Near a pole footprints are wide in longitude and no longer small figures of the sphere.
      const double bound = std::abs(at.lat_deg) < 80.0 ? cell * cell + step * step / 2 : 0.05 * cell;
      ASSERT_NEAR(value, cos_cos(at.lat_deg, at.lon_deg), bound) << level;
    });
  }
}

TEST(SampleNodes, GivesALinearGradientOfLatitudeExactly) {
  MemoryBudget budget = plenty();
  const SourceMap map = height_map(
      geometry_of(720, 360), [](double lat, double) { return lat; }, budget);
  for (const Filter filter : {Filter::kBilinear, Filter::kBicubic}) {
    const NodeGrid<float> grid = test::sample(map, filter, 7, budget);
    for_each_node(grid, [&](const Node& node, float value) {
      const double lat = degrees_from_normal(node_direction(node)).lat_deg;
      if (std::abs(lat) < 89.0) {
        ASSERT_NEAR(value, lat, 1e-5);
      }
    });
  }
}

TEST(SampleNodes, GivesALinearGradientAlongAMeridianAcrossThePole) {
  // On the plane tangent at the pole x = colatitude * cos(lon) is linear: what comes over the pole must fit.
  MemoryBudget budget = plenty();
  const auto plane = [](double lat, double lon) { return (90.0 - lat) * std::cos(lon * kDegree); };
  const SourceMap map = height_map(geometry_of(720, 360), plane, budget);
  for (const Filter filter : {Filter::kBilinear, Filter::kBicubic, Filter::kArea}) {
    const NodeGrid<float> grid = test::sample(map, filter, 9, budget);
    double error = 0;
    for_each_node(grid, [&](const Node& node, float value) {
      const Geodetic at = degrees_from_normal(node_direction(node));
      if (at.lat_deg > 89.0)
        error = std::max(error, std::abs(static_cast<double>(value) - plane(at.lat_deg, at.lon_deg)));
    });
    // Beside the pole a cell of 0.18 degrees spans 90 degrees of longitude: its mean is a tenth off.
    EXPECT_LE(error, filter == Filter::kArea ? 0.024 : 0.004) << static_cast<int>(filter);
  }
}

TEST(SampleNodes, JoinsTheMapAcrossTheAntimeridian) {
  MemoryBudget budget = plenty();
  const auto wave = [](double lat, double lon) { return cos_cos(lat, lon + 77.0); };
  for (const Extent& extent :
       {Extent{-180, -90, 180, 90}, Extent{0, -90, 360, 90}, Extent{-77, -90, 283, 90}}) {
    const MapGeometry geometry = geometry_of(720, 360, Registration::kArea, extent);
    const double step = geometry.step_deg * kDegree;
    const SourceMap map = height_map(geometry, wave, budget);
    EXPECT_LE(largest_error(test::sample(map, Filter::kBilinear, 8, budget), wave), step * step / 4 + 1e-7);
  }
}

TEST(SampleNodes, ReadsPointMapsWithAndWithoutTheRepeatedColumn) {
  MemoryBudget budget = plenty();
  for (const int width : {720, 721}) {
    const Extent extent{-180, -90, width == 721 ? 180.0 : 179.5, 90};
    const MapGeometry geometry = geometry_of(width, 361, Registration::kPoint, extent);
    const SourceMap map = height_map(geometry, cos_cos, budget);
    const double step = geometry.step_deg * kDegree;
    EXPECT_LE(largest_error(test::sample(map, Filter::kBilinear, 7, budget), cos_cos),
              step * step / 4 + 1e-7);
  }
}

TEST(SampleNodes, GivesNodesThatDiamondsShareEqualBits) {
  MemoryBudget budget = plenty();
  for (const int width : {36, 500, 2000}) {
    const SourceMap map = height_map(geometry_of(width, width / 2), random_value, budget);
    for (const Filter filter : kAllFilters) {
      for (const int level : {0, 1, 2, 6, 8})
        EXPECT_EQ(broken_edges(test::sample(map, filter, level, budget)), 0) << width << " level " << level;
    }
  }
}

TEST(SampleNodes, KeepsCoarseNodesAsSubsetOfFineOnesForInterpolation) {
  MemoryBudget budget = plenty();
  const SourceMap map = height_map(geometry_of(500, 250), random_value, budget);
  const NodeGrid<float> fine = test::sample(map, Filter::kBicubic, 7, budget);
  const NodeGrid<float> coarse = test::sample(map, Filter::kBicubic, 5, budget);
  for_each_node(coarse, [&](const Node& node, float value) {
    ASSERT_EQ(value, *fine.at(node.d, 4 * node.i, 4 * node.j));
  });
}

TEST(SampleNodes, AreaFilterIsTheMeanOverTheNodesOwnFootprint) {
  // Against brute force: points strewn over the footprint, each weighing cos(latitude).
  MemoryBudget budget = plenty();
  const auto wave = [](double lat, double lon) { return cos_cos(9 * lat + 20, 7 * lon); };
  const SourceMap map = height_map(geometry_of(2880, 1440), wave, budget);
  const MapGeometry& geometry = map.geometry();
  for (const int level : {2, 3, 4}) {
    const NodeGrid<float> grid = test::sample(map, Filter::kArea, level, budget);
    const int n = nodes_per_side(level);
    for (const Node& node : {Node{0, level, n / 2, n / 4}, Node{1, level, 1, 0}, Node{2, level, n, 0},
                             Node{3, level, n - 1, n - 1}}) {
      const Footprint footprint = footprint_of(geometry, node);
      const int column = place_of(geometry, node_direction(node)).x.whole;
      double sum = 0;
      double weight = 0;
      for (int b = 0; b < 400; ++b) {
        for (int a = 0; a < 400; ++a) {
          const double x = footprint.min_x() + (a + 0.5) / 400 * (footprint.max_x() - footprint.min_x());
          const double y = footprint.min_y() + (b + 0.5) / 400 * (footprint.max_y() - footprint.min_y());
          bool inside = false;
          for (int k = 0; k < footprint.count; ++k) {
            const auto p = footprint.corner[static_cast<std::size_t>(k)];
            const auto q = footprint.corner[static_cast<std::size_t>((k + 1) % footprint.count)];
            if ((y < p.y) != (y < q.y) && x < p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y)) inside = !inside;
          }
          if (!inside || y < -0.5 || y > geometry.height - 0.5) continue;
          const double lat = latitude_of(geometry, y);
          sum += std::cos(lat * kDegree) * wave(lat, geometry.west_deg + (column + x) * geometry.step_deg);
          weight += std::cos(lat * kDegree);
        }
      }
      EXPECT_NEAR(*grid.at(node.d, node.i, node.j), sum / weight, 0.003)
          << level << ": " << node.d << " " << node.i << " " << node.j;
    }
  }
}

TEST(SampleNodes, AreaFilterAveragesNoiseWhereInterpolationDoesNot) {
  MemoryBudget budget = plenty();
  const SourceMap map = height_map(geometry_of(2048, 1024), random_value, budget);
  const auto deviation = [&](Filter filter) {
    double sum = 0;
    int count = 0;
    for_each_node(test::sample(map, filter, 4, budget), [&](const Node&, float value) {
      sum += (static_cast<double>(value) - 200.0) * (static_cast<double>(value) - 200.0);
      ++count;
    });
    return std::sqrt(sum / count);
  };
  // Uniform noise of 1000 has a deviation of 289; some 32 x 32 samples go into one node.
  EXPECT_LE(deviation(Filter::kArea), 20.0);
  EXPECT_GE(deviation(Filter::kBilinear), 100.0);
}

TEST(SampleNodes, ReadingInBlocksChangesTheAreaMeanLittle) {
  MemoryBudget budget = plenty();
  const auto rough = [](double lat, double lon) {
    return 1000.0 * cos_cos(3 * lat, 5 * lon) + random_value(lat, lon);
  };
  const MapGeometry geometry = geometry_of(2048, 1024);
  const NodeGrid<float> whole = test::sample(height_map(geometry, rough, budget), Filter::kArea, 3, budget);
  const NodeGrid<float> reduced =
      test::sample(height_map(geometry, rough, budget, 4), Filter::kArea, 3, budget);
  for_each_node(whole, [&](const Node& node, float value) {
    ASSERT_NEAR(value, *reduced.at(node.d, node.i, node.j), 10.0);
  });
}

TEST(SampleNodes, DoesNotDependOnTheNumberOfThreads) {
  MemoryBudget budget = plenty();
  const SourceMap map = height_map(geometry_of(720, 360), random_value, budget);
  for (const Filter filter : {Filter::kBicubic, Filter::kArea}) {
    const NodeGrid<float> reference = test::sample(map, filter, 8, budget);
    for (const int threads : {1, 2, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
      tbb::task_arena arena(threads);
      arena.execute([&] {
        const NodeGrid<float> grid = test::sample(map, filter, 8, budget);
        for_each_node(grid, [&](const Node& node, float value) {
          ASSERT_EQ(value, *reference.at(node.d, node.i, node.j));
        });
      });
    }
  }
}

TEST(SampleNodes, GivesAnyRectangleTheBitsOfTheWhole) {
  MemoryBudget budget = plenty();
  const SourceMap map = height_map(geometry_of(600, 300), random_value, budget);
  constexpr int kLevel = 8;
  const NodeRect rects[] = {{0, kLevel, 0, 64, 257, 64},   // a block row
                            {1, kLevel, 0, 192, 257, 65},  // the last one, with the pole
                            {2, kLevel, 0, 0, 1, 1},       // a pole alone
                            {3, kLevel, 256, 256, 1, 1},   // the other
                            {0, kLevel, 61, 3, 70, 130},   // across blocks, aligned to nothing
                            {1, kLevel, 250, 120, 7, 5},   // at the border
                            {2, kLevel, 255, 254, 2, 3}};
  for (const Filter filter : kAllFilters) {
    const NodeGrid<float> whole = test::sample(map, filter, kLevel, budget);
    for (const NodeRect& rect : rects) {
      std::vector<float> part(static_cast<std::size_t>(rect.ni * rect.nj), kNan);
      std::vector<float> weights(part.size(), kNan);
      sample_rect(test::stack_of({&map}, filter), rect, Gaps::kFill, part.data(), weights.data());
      for (int j = 0; j < rect.nj; ++j) {
        for (int i = 0; i < rect.ni; ++i) {
          ASSERT_EQ(part[static_cast<std::size_t>(j * rect.ni + i)],
                    *whole.at(rect.d, rect.i0 + i, rect.j0 + j))
              << rect.d << ": " << rect.i0 + i << ", " << rect.j0 + j;
          ASSERT_EQ(weights[static_cast<std::size_t>(j * rect.ni + i)], 1.0F);
        }
      }
    }
  }
}

TEST(SampleNodes, FillsVoidsFromTheirNeighboursAndStaysWithinTheirRange) {
  MemoryBudget budget = plenty();
  const float voids[] = {kNan, std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(), -3.4e38F, 1e38F};
  const MapGeometry geometry = geometry_of(360, 180);
  for (const float bad : voids) {
    // Half the planet, single samples, and a pole are void.
    const SourceMap map = height_map(
        geometry,
        [&](double lat, double lon) {
          const bool hole =
              lon > 0 || (static_cast<int>(lat * 2) + static_cast<int>(lon * 2)) % 7 == 0 || lat < -85;
          return hole ? static_cast<double>(bad) : 500.0 + 300.0 * cos_cos(lat, lon);
        },
        budget);
    ASSERT_TRUE(map.has_voids());
    EXPECT_GT(map.void_share(), 0.5);
    EXPECT_LT(map.void_share(), 0.7);
    for (const Filter filter : kAllFilters) {
      const NodeGrid<float> grid = test::sample(map, filter, 7, budget);
      for_each_node(grid, [&](const Node&, float value) {
        ASSERT_TRUE(std::isfinite(value));
        ASSERT_GE(value, 199.9F);
        ASSERT_LE(value, 800.1F);
      });
      EXPECT_EQ(broken_edges(grid), 0);
    }
  }
}

TEST(SampleNodes, BicubicStaysWithinTheRangeOfItsSamples) {
  MemoryBudget budget = plenty();
  const SourceMap map = height_map(
      geometry_of(180, 90), [](double, double lon) { return lon > 0 ? 100.0 : 0.0; }, budget);
  for_each_node(test::sample(map, Filter::kBicubic, 8, budget), [](const Node&, float value) {
    ASSERT_GE(value, 0.0F);
    ASSERT_LE(value, 100.0F);
  });
}

TEST(SourceMap, KnowsVoidsOfEveryTypeAndRefusesMapsOfNothingElse) {
  MemoryBudget budget = plenty();
  const MapGeometry geometry = geometry_of(8, 4);
  const auto load = [&](SampleType type, double value, const ValueRule& rule) {
    test::FunctionRaster raster(8, 4, 1, type, [&](int x, int, int) { return x == 3 ? value : 7.0; });
    return SourceMap(raster, geometry, rule, 1, budget, [](double) {});
  };
  EXPECT_TRUE(load(SampleType::kInt16, -32768, {}).has_voids());
  EXPECT_FALSE(load(SampleType::kInt16, -32767, {}).has_voids());
  EXPECT_TRUE(load(SampleType::kUint8, 255, {MapKind::kHeights, 1, 0, 255}).has_voids());
  EXPECT_FALSE(load(SampleType::kUint8, 255, {}).has_voids());
  EXPECT_TRUE(load(SampleType::kFloat, -9999, {MapKind::kHeights, 1, 0, -9999}).has_voids());
  EXPECT_FALSE(load(SampleType::kFloat, 1e-42, {}).has_voids()) << "denormals are numbers";
  test::FunctionRaster nothing(8, 4, 1, SampleType::kInt16, [](int, int, int) { return -32768.0; });
  EXPECT_THROW(SourceMap(nothing, geometry, {}, 1, budget, [](double) {}), globe::Error);
}

TEST(SourceMap, ScalesRawNumbersToMetres) {
  MemoryBudget budget = plenty();
  test::FunctionRaster raster(8, 4, 1, SampleType::kUint16, [](int, int, int) { return 20000.0; });
  const SourceMap map(raster, geometry_of(8, 4), {MapKind::kHeights, 0.5, -8000, {}}, 1, budget,
                      [](double) {});
  EXPECT_EQ(*test::sample(map, Filter::kBilinear, 2, budget).at(1, 2, 1), 2000.0F);
}

}  // namespace
}  // namespace converters
