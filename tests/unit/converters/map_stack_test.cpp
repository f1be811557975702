#include "converters/map_stack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::degrees_from_normal;
using globe::geo::dvec3;
using globe::geo::Geodetic;
using globe::planet::Node;
using globe::planet::node_direction;
using test::broken_edges;
using test::for_each_node;
using test::kAllFilters;
using test::plenty;
using test::sample;
using test::stack_of;

constexpr int kStackLevel = 7;

double waves(double lat, double lon) {
  return 100.0 * std::cos(lat * kDegree) * std::cos(3 * lon * kDegree) + 10.0 * lat;
}

MapGeometry part(int width, int height, const Extent& extent) {
  return equirectangular_geometry("part", width, height, extent, Registration::kArea, Latitude::kGeodetic,
                                  globe::geo::kMoon);
}

SourceMap map_of(const MapGeometry& geometry, const std::function<double(double, double)>& f,
                 MemoryBudget& budget) {
  return test::height_map(geometry, f, budget);
}

/// Stereographic about a place, north up, `step` degrees (at the middle) a sample.
class Stereographic : public Projection {
 public:
  Stereographic(const Geodetic& middle, int size, double step_deg)
      : frame_(globe::geo::local_frame(middle.lat_deg, middle.lon_deg)), size_(size), step_deg_(step_deg) {}

  void find(const dvec3* directions, std::size_t count, double /*reach*/, SamplePoint* out) const override {
    for (std::size_t k = 0; k < count; ++k) {
      const dvec3& u = directions[k];
      const double scale = 2.0 / (1.0 + glm::dot(u, frame_.up)) / kDegree / step_deg_;
      const bool near = glm::dot(u, frame_.up) > 0.5;
      out[k] = near ? SamplePoint{0.5 * (size_ - 1) + scale * glm::dot(u, frame_.east),
                                  0.5 * (size_ - 1) - scale * glm::dot(u, frame_.north)}
                    : SamplePoint::nowhere();
    }
  }
  double samples_per_quadrant() const override { return 90.0 / step_deg_; }
  double turn() const override { return 0; }

  dvec3 direction(double x, double y) const {
    const double a = (x - 0.5 * (size_ - 1)) * step_deg_ * kDegree / 2.0;
    const double b = (0.5 * (size_ - 1) - y) * step_deg_ * kDegree / 2.0;
    const double r2 = a * a + b * b;
    return (2.0 * a * frame_.east + 2.0 * b * frame_.north + (1.0 - r2) * frame_.up) / (1.0 + r2);
  }

 private:
  globe::geo::LocalFrame frame_;
  int size_;
  double step_deg_;
};

SourceMap stereographic_map(const Geodetic& middle, int size, double step_deg,
                            const std::function<double(double, double)>& f, MemoryBudget& budget,
                            int factor = 1) {
  const auto projection = std::make_shared<Stereographic>(middle, size, step_deg);
  test::FunctionRaster raster(size, size, 1, SampleType::kFloat, [&](int x, int y, int) {
    const Geodetic at = degrees_from_normal(projection->direction(x, y));
    return f(at.lat_deg, at.lon_deg);
  });
  return SourceMap(raster, projected_geometry(size, size, projection), {}, factor, budget, [](double) {});
}

/// Runs body(node, value, weight, place) over a diamond.
template <typename Body>
void for_each_sample(const MapStack& maps, int d, int level, Gaps gaps, const Body& body) {
  const NodeRect rect = whole_diamond(d, level);
  std::vector<float> values(static_cast<std::size_t>(rect.ni * rect.nj)), weights(values.size());
  sample_rect(maps, rect, gaps, values.data(), weights.data());
  for (int j = 0; j < rect.nj; ++j) {
    for (int i = 0; i < rect.ni; ++i) {
      const auto k = static_cast<std::size_t>(j * rect.ni + i);
      body(Node{d, level, i, j}, static_cast<double>(values[k]), static_cast<double>(weights[k]),
           degrees_from_normal(node_direction({d, level, i, j})));
    }
  }
}

TEST(MapStack, PartsOfOneLatticeThatAdjoinGiveWhatTheWholeGives) {
  MemoryBudget budget = plenty();
  const SourceMap whole = map_of(part(720, 360, {-180, -90, 180, 90}), waves, budget);
  const SourceMap west = map_of(part(360, 360, {-180, -90, 0, 90}), waves, budget);
  const SourceMap north = map_of(part(360, 180, {0, 0, 180, 90}), waves, budget);
  const SourceMap south = map_of(part(360, 180, {0, -90, 180, 0}), waves, budget);
  for (const Filter filter : {Filter::kNearest, Filter::kBilinear, Filter::kArea}) {
    const NodeGrid<float> reference = sample(whole, filter, kStackLevel, budget);
    const NodeGrid<float> joined = sample(stack_of({&west, &north, &south}, filter), kStackLevel, budget);
    for_each_node(joined, [&](const Node& node, float value) {
      const Geodetic at = degrees_from_normal(node_direction(node));
      // The parts know of no row beyond a pole, and between two samples rounding picks the nearest.
      const bool between = std::abs(2 * at.lon_deg - std::round(2 * at.lon_deg)) < 1e-9;
      if (std::abs(at.lat_deg) > 88.0 || (filter == Filter::kNearest && between)) return;
      ASSERT_NEAR(value, *reference.at(node.d, node.i, node.j), 1e-3) << static_cast<int>(filter);
    });
    EXPECT_EQ(broken_edges(joined), 0);
  }
}

TEST(MapStack, LaterMapsLieOverEarlierOnesAndTheirVoidsShowThem) {
  MemoryBudget budget = plenty();
  const auto constant = [](double value) { return [=](double, double) { return value; }; };
  const SourceMap base = map_of(part(360, 180, {-180, -90, 180, 90}), constant(1.0), budget);
  const auto with_hole = [](double lat, double lon) {
    return std::abs(lat - 30) < 5 && std::abs(lon - 40) < 5 ? NAN : 2.0;
  };
  const SourceMap later = map_of(part(800, 400, {20, 10, 60, 50}), with_hole, budget);
  for (const Filter filter : kAllFilters) {
    for (const bool base_first : {true, false}) {
      const MapStack maps =
          base_first ? stack_of({&base, &later}, filter) : stack_of({&later, &base}, filter);
      for_each_sample(maps, 0, kStackLevel, Gaps::kFill,
                      [&](const Node& node, double value, double weight, const Geodetic& at) {
                        ASSERT_FLOAT_EQ(static_cast<float>(weight), 1.0F);
                        const auto inside = [&](double rim) {
                          return std::abs(at.lat_deg - 30) < 20 + rim && std::abs(at.lon_deg - 40) < 20 + rim;
                        };
                        const auto in_hole = [&](double rim) {
                          return std::abs(at.lat_deg - 30) < 5 + rim && std::abs(at.lon_deg - 40) < 5 + rim;
                        };
                        const double rim = 1.5;  // two cells of the grid
                        if (!base_first || !inside(rim) || in_hole(-rim)) {
                          ASSERT_EQ(value, 1.0) << node.i << ", " << node.j;
                        } else if (inside(-rim) && !in_hole(rim)) {
                          ASSERT_EQ(value, 2.0) << node.i << ", " << node.j;
                        } else {
                          ASSERT_GE(value, 1.0);
                          ASSERT_LE(value, 2.0);
                        }
                      });
    }
  }
}

TEST(MapStack, TellsWhichNodesNothingReachesAndFillsOnlyVoids) {
  MemoryBudget budget = plenty();
  const SourceMap map = map_of(
      part(400, 400, {20, 10, 60, 50}),
      [](double lat, double lon) { return std::abs(lat - 30) < 5 && std::abs(lon - 40) < 5 ? NAN : 7.0; },
      budget);
  for (const Filter filter : kAllFilters) {
    for (const Gaps gaps : {Gaps::kZero, Gaps::kFill}) {
      int voids = 0, outside = 0;
      for_each_sample(stack_of({&map}, filter), 0, kStackLevel, gaps,
                      [&](const Node&, double value, double weight, const Geodetic& at) {
                        if (std::abs(at.lat_deg - 30) < 3 && std::abs(at.lon_deg - 40) < 3) {
                          ++voids;
                          ASSERT_EQ(weight, 0.0);
                          ASSERT_FLOAT_EQ(static_cast<float>(value), gaps == Gaps::kFill ? 7.0F : 0.0F);
                        }
                        if (at.lat_deg < 8 || at.lon_deg < 18 || at.lon_deg > 62) {
                          ++outside;
                          ASSERT_EQ(weight, 0.0);
                          ASSERT_EQ(value, 0.0);
                        }
                      });
      EXPECT_GT(voids, 20);
      EXPECT_GT(outside, 1000);
    }
  }
}

TEST(MapStack, FollowsAFunctionThroughAProjection) {
  MemoryBudget budget = plenty();
  // Over a pole, the antimeridian with the equator, and a plain place.
  for (const Geodetic& middle : {Geodetic{90, 0}, Geodetic{-88, 130}, Geodetic{0, 179}, Geodetic{47, 11}}) {
    const SourceMap map = stereographic_map(middle, 400, 0.1, waves, budget);
    for (const Filter filter : kAllFilters) {
      const NodeGrid<float> grid = sample(stack_of({&map}, filter), kStackLevel, budget, Gaps::kZero);
      EXPECT_EQ(broken_edges(grid), 0);
      double worst = 0;
      int inside = 0;
      const dvec3 up = globe::geo::normal_from_degrees(middle.lat_deg, middle.lon_deg);
      for_each_node(grid, [&](const Node& node, float value) {
        const dvec3 u = node_direction(node);
        const double away = std::acos(std::min(1.0, glm::dot(u, up))) / kDegree;
        const Geodetic at = degrees_from_normal(u);
        if (away < 19) {
          ++inside;
          worst = std::max(worst, std::abs(static_cast<double>(value) - waves(at.lat_deg, at.lon_deg)));
        }
        if (away > 31) {
          ASSERT_EQ(value, 0.0F);
        }
      });
      EXPECT_GT(inside, 500);
      // A slope of 10 a degree and the kink of |lat| at the pole.
      EXPECT_LE(worst, filter == Filter::kNearest ? 1.4
                       : filter == Filter::kArea  ? 4.0
                                                  : 1.0)
          << middle.lat_deg << ", filter " << static_cast<int>(filter);
    }
  }
}

TEST(MapStack, AreaFilterAveragesManySamplesOfAPartInBlocks) {
  MemoryBudget budget = plenty();
  const auto noisy = [](double lat, double lon) {
    const double x = std::sin(lat * 127.1 + lon * 311.7) * 43758.5453;
    return waves(lat, lon) + 100.0 * (x - std::floor(x) - 0.5);
  };
  const SourceMap whole = stereographic_map({47, 11}, 1001, 0.03, noisy, budget);
  const SourceMap blocks = stereographic_map({47, 11}, 1001, 0.03, noisy, budget, 4);
  constexpr int kCoarse = 5;
  const NodeGrid<float> a = sample(stack_of({&whole}, Filter::kArea), kCoarse, budget, Gaps::kZero);
  const NodeGrid<float> b = sample(stack_of({&blocks}, Filter::kArea), kCoarse, budget, Gaps::kZero);
  int inside = 0;
  for_each_node(a, [&](const Node& node, float value) {
    const dvec3 u = node_direction(node);
    if (glm::dot(u, globe::geo::normal_from_degrees(47, 11)) < std::cos(10 * kDegree)) return;
    ++inside;
    ASSERT_NEAR(value, *b.at(node.d, node.i, node.j), 0.5);
    const Geodetic at = degrees_from_normal(u);
    ASSERT_NEAR(value, waves(at.lat_deg, at.lon_deg), 2.0);
  });
  EXPECT_GT(inside, 20);
}

TEST(MapStack, SamplesPartsAtDeepLevels) {
  MemoryBudget budget = plenty();
  constexpr int kDeep = 22;
  const Geodetic middle{46.2, 7.1};
  const SourceMap map = stereographic_map(
      middle, 300, 2e-5, [](double lat, double lon) { return (lat - 46.2) * 1e5 + (lon - 7.1) * 1e4; },
      budget);
  const globe::planet::Place place =
      globe::planet::locate(globe::geo::normal_from_degrees(middle.lat_deg, middle.lon_deg), kDeep);
  const NodeRect rect{place.d, kDeep, static_cast<int>(place.ij.x) - 20, static_cast<int>(place.ij.y) - 33,
                      41,      67};
  std::vector<float> values(41 * 67), weights(41 * 67);
  sample_rect(stack_of({&map}, Filter::kBilinear), rect, Gaps::kZero, values.data(), weights.data());
  for (int j = 0; j < rect.nj; ++j) {
    for (int i = 0; i < rect.ni; ++i) {
      const auto k = static_cast<std::size_t>(j * rect.ni + i);
      const Geodetic at = degrees_from_normal(node_direction({rect.d, kDeep, rect.i0 + i, rect.j0 + j}));
      ASSERT_EQ(weights[k], 1.0F);
      ASSERT_NEAR(values[k], (at.lat_deg - 46.2) * 1e5 + (at.lon_deg - 7.1) * 1e4, 0.01);
    }
  }
}

}  // namespace
}  // namespace converters
