#include "globe/planet/drawn_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/htm/trixel.h"
#include "globe/planet/interpolation.h"
#include "tests/hard/directions.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

using hard::random_direction;

constexpr double kError_m = 1e-8;

/// A planet without a sea, of heights -9 to 9 km without any order, at level 6.
class DrawnGroundTest : public testing::Test {
 protected:
  static std::shared_ptr<const Surface> surface(const geo::Ellipsoid& ellipsoid) {
    const tests::TemporaryFolder folder;
    tests::write_node_planet(folder.path(), 6, ellipsoid, tests::hashed_heights(3, -9000, 9000));
    return tests::open_surface(folder.path());
  }
};

Node any_node(std::mt19937_64& random, int level) {
  std::uniform_int_distribution<> coordinate(0, nodes_per_side(level));
  return {static_cast<int>(random() % 4), level, coordinate(random), coordinate(random)};
}

TEST_F(DrawnGroundTest, AtANodeIsTheNodesOwnHeight) {
  std::mt19937_64 random(1);
  for (const auto& ellipsoid : {geo::kWgs84, geo::kMoon, geo::Ellipsoid{6.4e6, 0.1}}) {
    const auto planet = surface(ellipsoid);
    for (int level = 0; level <= 9; ++level) {
      const int n = nodes_per_side(level);
      for (int k = 0; k < 60; ++k) {
        const Node node = k < 4   ? Node{k, level, 0, 0}
                          : k < 8 ? Node{k - 4, level, n, 0}
                                  : any_node(random, level);
        EXPECT_NEAR(drawn_ground(*planet, node_direction(node), level).height_m, planet->height(node),
                    10 * kError_m)
            << level << ' ' << node.i << ' ' << node.j;
      }
    }
  }
}

TEST_F(DrawnGroundTest, OfASmoothSphereIsItsSagitta) {
  const tests::TemporaryFolder folder;
  tests::write_node_planet(folder.path(), 4, geo::kMoon, [](const Node&) { return 1000.0; });
  const auto planet = tests::open_surface(folder.path());
  const double radius = geo::kMoon.a + 1000.0;
  std::mt19937_64 random(2);
  for (int k = 0; k < 2000; ++k) {
    const dvec3 u = random_direction(random);
    const int level = k % 5;
    const htm::Corners c = htm::corners(htm::trixel_at(u, level));
    const dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    const double along = radius * glm::dot(normal, c[0]) / glm::dot(normal, u);
    EXPECT_NEAR(drawn_ground(*planet, u, level).height_m, along - geo::kMoon.a, kError_m);
  }
}

// On a sphere the flat trixel is the cone over the trixel of normals; with heights of one trixel it is
// inclined, and its points move by a share of its height in the radius.
TEST_F(DrawnGroundTest, LiesBelowLinearInterpolationByTheSagittaAtMost) {
  std::mt19937_64 random(3);
  for (const auto& ellipsoid : {geo::kWgs84, geo::kMoon}) {
    const auto planet = surface(ellipsoid);
    const double e2 = ellipsoid.f * (2 - ellipsoid.f);
    for (int k = 0; k < 3000; ++k) {
      const dvec3 u = random_direction(random);
      const int level = 2 + k % 5;
      const Height linear = height_at(*planet, u, level, Interpolation::kLinear);
      const htm::Corners c = htm::corners(htm::trixel_at(u, level));
      const double edge =
          std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
      const double sagitta = (ellipsoid.a + 9000) * edge * edge / 6 * 1.1;
      const double inclined = 18000 * (2 * 9000 / ellipsoid.b() + 2 * e2 * edge);
      const double below = linear.height_m - drawn_ground(*planet, u, level).height_m;
      EXPECT_LE(below, sagitta + inclined) << level;
      EXPECT_GE(below, -inclined) << level;
    }
  }
}

TEST_F(DrawnGroundTest, IsContinuousAcrossEdgesAndCorners) {
  std::mt19937_64 random(4);
  constexpr double kStep = 1e-12;                    // 6 micrometres
  constexpr double kSteepest_m = 6.4e6 * kStep * 2;  // slopes of 2, at level 6 18 km on 100 km
  for (const auto& ellipsoid : {geo::kWgs84, geo::Ellipsoid{6.4e6, 0.1}}) {
    const auto planet = surface(ellipsoid);
    for (int k = 0; k < 4000; ++k) {
      const int level = k % 7;
      const Node node = k % 3 == 0 ? Node{k % 4, level, 0, 0} : any_node(random, level);
      const htm::Corners c = htm::corners(htm::trixel_at(node_direction(node), level));
      const double share = k % 5 == 0 ? 0.0 : std::uniform_real_distribution<>(0, 1)(random);
      const dvec3 on = glm::normalize((1 - share) * c[0] + share * c[1]);
      const dvec3 aside = kStep * random_direction(random);
      EXPECT_NEAR(drawn_ground(*planet, glm::normalize(on + aside), level).height_m,
                  drawn_ground(*planet, glm::normalize(on - aside), level).height_m, kSteepest_m + kError_m)
          << level;
    }
  }
}

TEST_F(DrawnGroundTest, FollowsTheMeshWhereTheNormalLeavesItsTrixel) {
  const auto planet = surface({6.4e6, 0.1});
  std::mt19937_64 random(5);
  int left = 0;
  for (int k = 0; k < 3000; ++k) {
    const dvec3 u = random_direction(random);
    const int level = 1 + k % 4;
    const DrawnGround ground = drawn_ground(*planet, u, level);
    const htm::Corners own = htm::corners(htm::trixel_at(u, level));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GE(ground.weights[c], -1e-12);
    EXPECT_NEAR(ground.weights[0] + ground.weights[1] + ground.weights[2], 1.0, 1e-12);
    left += std::any_of(ground.nodes.begin(), ground.nodes.end(), [&](const Node& node) {
      return std::find(own.begin(), own.end(), node_direction(node)) == own.end();
    });
  }
  EXPECT_GT(left, 3);
}

TEST_F(DrawnGroundTest, OfSeaIsNeverAboveTheSea) {
  const auto planet = Surface::builtin(1);
  std::mt19937_64 random(6);
  int seas = 0;
  for (int k = 0; k < 500; ++k) {
    const dvec3 u = random_direction(random);
    const DrawnGround ground = drawn_ground(*planet, u, 8);
    const bool sea = std::all_of(ground.nodes.begin(), ground.nodes.end(),
                                 [&](const Node& node) { return planet->height(node) <= 0.0; });
    seas += sea;
    if (!sea) continue;
    EXPECT_LE(ground.height_m, kError_m);
    EXPECT_GE(ground.height_m, -150.0);  // edges of 60 km: L²/6R = 94 m, the longest a quarter longer
  }
  EXPECT_GT(seas, 100);
}

}  // namespace
}  // namespace globe::planet
