#include "app/flat_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "tests/unit/flat/rough_ground.h"

namespace app {
namespace {

using glm::dvec3;
using globe::flat::Terrain;

constexpr double kLeastAbove = 2.0;

/// A view over the region, its place in shares of its sides.
FlatView view_over(const Terrain& terrain, double east, double north, double above_m, const Look& look) {
  const double x = terrain.x_m(0) + east * (terrain.posts().columns - 1) * terrain.spacing_m();
  const double y = terrain.y_m(0) + north * (terrain.posts().rows - 1) * terrain.spacing_m();
  return {terrain.frame().geodetic_from_local({x, y, terrain.z_at(x, y) + above_m}), look};
}

double above(const Terrain& terrain, const FlatView& view) {
  return terrain.height_above(globe::geo::ecef_from_geodetic(terrain.frame().ellipsoid(), view.place));
}

TEST(FlatFlight, BeginsAndEndsInItsViews) {
  const auto terrain = rough_terrain(12, 12);
  const FlatView from = view_over(*terrain, 0.1, 0.2, 500.0, {350.0, -30.0});
  const FlatView to = view_over(*terrain, 0.8, 0.9, 60.0, {20.0, -5.0});
  const FlatFlight flight(*terrain, from, to);
  for (const auto& [seen, asked] : {std::pair{flight.at(0.0), from}, std::pair{flight.at(1.0), to}}) {
    EXPECT_NEAR(seen.place.lat_deg, asked.place.lat_deg, 1e-9);
    EXPECT_NEAR(seen.place.lon_deg, asked.place.lon_deg, 1e-9);
    EXPECT_NEAR(std::remainder(seen.look.heading_deg - asked.look.heading_deg, 360.0), 0.0, 1e-9);
    EXPECT_NEAR(seen.look.pitch_deg, asked.look.pitch_deg, 1e-6);
    EXPECT_GE(seen.place.h_m, asked.place.h_m - 1e-3);
  }
  EXPECT_LE(std::abs(std::remainder(flight.at(0.5).look.heading_deg, 360.0)), 10.0);  // the short way round
}

TEST(FlatFlight, IsNeverUnderTheGround) {
  const auto terrain = rough_terrain(24, 24);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double least_m = 1e9;
  for (int k = 0; k < 40; ++k) {
    const auto end = [&] {
      return view_over(*terrain, unit(random), unit(random), 2.0 * std::pow(500.0, unit(random)),
                       {0.0, -5.0});
    };
    const FlatView from = end();
    const FlatFlight flight(*terrain, from, end());
    for (int frame = 0; frame <= 300; ++frame)
      least_m = std::min(least_m, above(*terrain, flight.at(frame / 300.0)));
  }
  EXPECT_GE(least_m, kLeastAbove - 1e-3);
}

TEST(FlatFlight, RisesAsFarAsItGoesAndLooksDownFromThere) {
  const auto terrain = rough_terrain(64, 64);  // 31 km a side
  const FlatFlight far(*terrain, view_over(*terrain, 0.1, 0.1, 50.0, {0.0, -5.0}),
                       view_over(*terrain, 0.9, 0.9, 50.0, {0.0, -5.0}));
  const FlatFlight near(*terrain, view_over(*terrain, 0.5, 0.5, 50.0, {0.0, -5.0}),
                        view_over(*terrain, 0.501, 0.501, 50.0, {0.0, -5.0}));
  EXPECT_GT(above(*terrain, far.at(0.5)), 10e3);
  EXPECT_LT(far.at(0.5).look.pitch_deg, -60.0);
  EXPECT_LT(above(*terrain, near.at(0.5)), 1000.0);
}

TEST(FlatFlight, GoesSmoothly) {
  const auto terrain = rough_terrain(24, 24);
  const FlatFlight flight(*terrain, view_over(*terrain, 0.1, 0.5, 100.0, {90.0, -5.0}),
                          view_over(*terrain, 0.9, 0.5, 30.0, {90.0, -5.0}));
  // The picture moves by the way gone over the height: from frame to frame that changes little.
  constexpr int kFrames = 2000;
  std::vector<double> speed;
  for (int k = 0; k < kFrames; ++k) {
    const FlatView a = flight.at(static_cast<double>(k) / kFrames);
    const FlatView b = flight.at((k + 1.0) / kFrames);
    const auto at = [&](const FlatView& view) { return terrain->frame().local_from_geodetic(view.place); };
    speed.push_back(glm::distance(at(a), at(b)) / std::max(above(*terrain, a), 10.0));
  }
  const double fastest = *std::max_element(speed.begin(), speed.end());
  EXPECT_LT(speed.front(), 0.01 * fastest);
  EXPECT_LT(speed.back(), 0.05 * fastest);
  for (int k = 0; k + 1 < kFrames; ++k)
    EXPECT_LT(std::abs(speed[static_cast<std::size_t>(k) + 1] - speed[static_cast<std::size_t>(k)]),
              0.1 * fastest)
        << k;
}

}  // namespace
}  // namespace app
