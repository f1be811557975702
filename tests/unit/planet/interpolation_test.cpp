#include "globe/planet/interpolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

constexpr double kRounding_m =
    1e-6;  ///< weights err by some 1e-13 of heights below 1e4 m, near edges by more

const Surface& surface() {
  static const auto surface = Surface::builtin(5);
  return *surface;
}

double at(const dvec3& u, int level, Interpolation interpolation) {
  return height_at(surface(), u, level, interpolation).height_m;
}

dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<> normal;
  dvec3 u{normal(random), normal(random), normal(random)};
  return u / std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
}

TEST(HeightAt, LinearIsTheFlatTrixelOfTheSurface) {
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    const dvec3 u = random_direction(random);
    const int level = k % 12;
    EXPECT_NEAR(at(u, level, Interpolation::kLinear), surface().height(u, level), kRounding_m);
  }
}

TEST(HeightAt, EveryInterpolationKeepsTheNodes) {
  std::mt19937 random(2);
  for (const int level : {0, 1, 2, 5, 9, 11}) {
    const int n = nodes_per_side(level);
    for (int k = 0; k < 50; ++k) {
      std::uniform_int_distribution<> coordinate(0, n);
      const Node node{k % 4, level, coordinate(random), coordinate(random)};
      const double height = surface().height(node);
      for (const auto kind : {Interpolation::kNearest, Interpolation::kLinear, Interpolation::kCubic})
        EXPECT_NEAR(at(node_direction(node), level, kind), height, 1e-4)
            << level << ' ' << node.i << ' ' << node.j;
    }
  }
}

TEST(HeightAt, NearestAndLinearStayWithinTheTrixelAndCubicWithinItsStencil) {
  std::mt19937 random(3);
  for (int k = 0; k < 2000; ++k) {
    const dvec3 u = random_direction(random);
    const int level = k % 10;
    const Place place = locate(u, level);
    const int i = std::min(static_cast<int>(place.ij.x), nodes_per_side(level) - 1);
    const int j = std::min(static_cast<int>(place.ij.y), nodes_per_side(level) - 1);
    double low = 1e9, high = -1e9;
    for (int dj = -2; dj <= 3; ++dj) {
      for (int di = -2; di <= 3; ++di) {
        const double height = surface().height(fold({place.d, level, i + di, j + dj}));
        low = std::min(low, height);
        high = std::max(high, height);
      }
    }
    const double cubic = at(u, level, Interpolation::kCubic);
    EXPECT_GE(cubic, low);
    EXPECT_LE(cubic, high);
    const Height nearest = height_at(surface(), u, level, Interpolation::kNearest);
    EXPECT_LE(std::abs(nearest.height_m - at(u, level, Interpolation::kLinear)),
              nearest.spread_m + kRounding_m);
  }
}

// Two places 1e-9 apart on either side of an edge; a jump would show as hundreds of metres.
TEST(HeightAt, CubicIsContinuousAcrossDiamondsAndAtTheirCorners) {
  constexpr double kStep_deg = 1e-7;
  constexpr double kSteepest_m = 0.01;  ///< of 1e-7 degrees, 1 cm on the ground
  for (const int level : {1, 2, 4, 9}) {
    for (const double lon : {0.0, 90.0, 180.0, -90.0}) {
      for (double lat = -89.95; lat < 90.0; lat += 1.15) {
        EXPECT_NEAR(at(geo::normal_from_degrees(lat, lon - kStep_deg), level, Interpolation::kCubic),
                    at(geo::normal_from_degrees(lat, lon + kStep_deg), level, Interpolation::kCubic),
                    kSteepest_m)
            << level << ' ' << lat << ' ' << lon;
      }
    }
  }
}

TEST(SurfaceHeight, IsThatOfTheTilesDownToTheDataLevel) {
  std::mt19937 random(4);
  for (int level = 0; level <= surface().data_level(); ++level) {
    std::uniform_int_distribution<> coordinate(0, nodes_per_side(level));
    for (int k = 0; k < 20; ++k) {
      const Node node{k % 4, level, coordinate(random), coordinate(random)};
      EXPECT_EQ(surface().height(node), surface().tile(tile_of(node))->height.at(node.i, node.j)) << level;
    }
  }
}

}  // namespace
}  // namespace globe::planet
