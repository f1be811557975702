#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/htm/cone.h"
#include "globe/planet/interpolation.h"
#include "globe/planet/profile.h"
#include "globe/planet/sight.h"
#include "globe/planet/summary.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

// Questions to a planet with insets, against looking at every node or many places of the ground.

namespace globe::planet {
namespace {

constexpr int kCoarseLevel = 6;
constexpr int kFineLevel = 9;

class InsetQuestions : public testing::Test {
 protected:
  InsetQuestions() {
    tests::write_node_planet(scratch_ / "planet", kCoarseLevel, geo::kWgs84,
                             tests::hashed_heights(1, 0.0, 2000.0));
    // One over an octahedron corner, one inside a diamond.
    tests::add_inset(scratch_ / "planet",
                     {"corner", kFineLevel, corner_, 0.05, 0.12, tests::hashed_heights(2, 3000.0, 5000.0)});
    tests::add_inset(scratch_ / "planet", {"inside", kFineLevel - 1, inside_, 0.05, 0.12,
                                           tests::hashed_heights(3, -4000.0, -2000.0)});
    surface_ = tests::open_surface(scratch_ / "planet");
  }

  const dvec3 corner_ = geo::normal_from_degrees(1.0, 90.5);
  const dvec3 inside_ = geo::normal_from_degrees(30.0, 130.0);
  tests::TemporaryFolder scratch_;
  std::shared_ptr<const Surface> surface_;
};

TEST_F(InsetQuestions, SummaryFindsTheExtremesOfEveryNodeOfTheFinestData) {
  const htm::Cone region(geo::normal_from_degrees(15.0, 110.0), 34.0);
  const auto found = summarize(*surface_, region, std::nullopt);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->level, kFineLevel);
  double low = 1e9, high = -1e9;
  const int n = nodes_per_side(kFineLevel);
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const Node node{d, kFineLevel, i, j};
        if (!region.contains(node_direction(node))) continue;
        const double height = surface_->data_height(node);
        low = std::min(low, height);
        high = std::max(high, height);
      }
    }
  }
  EXPECT_NEAR(found->lowest.height_m, low, 1e-9);
  EXPECT_NEAR(found->highest.height_m, high, 1e-9);
  EXPECT_NEAR(data_height_at(*surface_, found->highest.at, Interpolation::kLinear).height_m, high, 1e-5);

  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double sum = 0.0, squares = 0.0;
  int count = 0;
  while (count < 200000) {
    const dvec3 p(unit(random), unit(random), unit(random));
    if (glm::dot(p, p) > 1.0 || !region.contains(glm::normalize(p))) continue;
    const double height = data_height_at(*surface_, glm::normalize(p), Interpolation::kLinear).height_m;
    sum += height;
    squares += height * height;
    ++count;
  }
  const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
  EXPECT_NEAR(found->mean_m, mean, 5.0 * error + 2.0);  // on the ellipsoid areas are a little different
}

TEST_F(InsetQuestions, SummaryOfACoarseLevelTakesItsNodesWithTheInsets) {
  const htm::Cone region(corner_, 11.0);
  for (const int level : {kCoarseLevel - 1, kCoarseLevel}) {
    const auto found = summarize(*surface_, region, level);
    ASSERT_TRUE(found.has_value());
    double low = 1e9, high = -1e9;
    std::uint64_t samples = 0;
    const int n = nodes_per_side(level);
    for (int d = 0; d < kDiamonds; ++d) {
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          const Node node{d, level, i, j};
          if (!region.contains(node_direction(node))) continue;
          const Names all = names(node);
          const bool first = std::all_of(all.node.begin(), all.node.begin() + all.count,
                                         [&](const Node& other) { return d <= other.d; });
          samples += first ? 1 : 0;
          low = std::min(low, surface_->height(node));
          high = std::max(high, surface_->height(node));
        }
      }
    }
    EXPECT_EQ(found->samples, samples);
    EXPECT_EQ(found->lowest.height_m, low);
    EXPECT_EQ(found->highest.height_m, high);
    EXPECT_GT(high, 3000.0);
  }
}

TEST_F(InsetQuestions, SightLooksOverTheInsets) {
  const SightSettings settings{surface_->finest_data_level(), 0.0, true};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> lat(-8.0, 40.0), lon(80.0, 145.0), up(10.0, 9000.0);
  int seen = 0, blocked = 0;
  for (int k = 0; k < 60; ++k) {
    geo::Geodetic a{lat(random), lon(random), 0.0}, b{a.lat_deg + lat(random) * 0.15, a.lon_deg + 2.0, 0.0};
    a.h_m = sight_ground(*surface_, a, settings) + up(random);
    b.h_m = sight_ground(*surface_, b, settings) + up(random);
    const Sight look = sight(*surface_, a, b, settings);
    (look.visible ? seen : blocked) += 1;
    const dvec3 from = geo::ecef_from_geodetic(geo::kWgs84, a), to = geo::ecef_from_geodetic(geo::kWgs84, b);
    double least = 1e9;
    for (int step = 0; step <= 4000; ++step) {
      const double t = step / 4000.0;
      const geo::Geodetic at = geo::geodetic_from_ecef(geo::kWgs84, (1.0 - t) * from + t * to);
      least = std::min(least, at.h_m - sight_ground(*surface_, at, settings));
    }
    EXPECT_LE(look.lowest.clearance_m, least + 1e-6);
    EXPECT_GE(look.lowest.clearance_m, least - 30.0);  // between two steps
    EXPECT_EQ(look.visible, look.lowest.clearance_m > -1e-6);
  }
  EXPECT_GT(seen, 5);
  EXPECT_GT(blocked, 5);
}

TEST_F(InsetQuestions, GroundOfSightIsThatOfHeight) {
  const SightSettings settings{surface_->finest_data_level(), 0.0, true};
  for (double t = -0.2; t <= 0.2; t += 0.004) {  // apart by what is linear in finer or coarser trixels
    const geo::Geodetic at{1.0 + 60.0 * t, 90.5 + 31.0 * t, 0.0};
    const double height =
        data_height_at(*surface_, geo::normal_from_degrees(at.lat_deg, at.lon_deg), Interpolation::kLinear)
            .height_m;
    EXPECT_NEAR(sight_ground(*surface_, at, settings), height, 0.5);
  }
}

TEST_F(InsetQuestions, ProfileByTheDataHasNoStepAtARim) {
  const geo::Geodetic a{1.0, 78.0, 0.0}, b{1.0, 90.5, 0.0};
  const auto samples = profile(*surface_, a, b, 20001, std::nullopt, Interpolation::kLinear);
  double steepest = 0.0;
  for (std::size_t k = 1; k < samples.size(); ++k)
    steepest = std::max(steepest, std::abs(samples[k].height_m - samples[k - 1].height_m));
  // 70 m a sample: nodes 20 km apart, up to 2000 m (their own) and 5000 m (the blend over 0.07) different.
  EXPECT_LT(steepest, 70.0 / 12000.0 * 2000.0 + 70.0 / 440000.0 * 1.5 * 5000.0 + 1.0);
  EXPECT_EQ(data_levels_along(*surface_, a, b).coarsest, kCoarseLevel);
  EXPECT_EQ(data_levels_along(*surface_, a, b).finest, kFineLevel);
}

}  // namespace
}  // namespace globe::planet
