#include "flat/tangent_frame.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "flat/height_grid.h"

namespace {

using namespace globe::flat;
namespace geo = globe::geo;

TEST(TangentFrame, TheCornerOfARegionOf160KilometresLiesAKilometreBelowThePlane) {
  for (const double lat : {0.0, 46.0, -75.0, 90.0}) {
    const TangentFrame frame(geo::kWgs84, lat, 10.0);
    const double z = frame.z_at(80'000, 80'000, 0.0);
    EXPECT_NEAR(z, -1003.0, 8.0) << lat;  // R differs by 0.7 %
    EXPECT_NEAR(frame.geodetic_from_local({80'000, 80'000, z}).h_m, 0.0, 1e-6) << lat;
  }
}

TEST(TangentFrame, PlacesAreThoseOfTheEllipsoid) {
  for (const double lon : {-122.0, 0.0, 179.99, -180.0}) {
    const TangentFrame frame(geo::kWgs84, 36.0, lon);
    for (const glm::dvec3 local :
         {glm::dvec3(0, 0, 0), glm::dvec3(30'000, -50'000, 4000), glm::dvec3(-80'000, 80'000, -900)}) {
      const geo::Geodetic place = frame.geodetic_from_local(local);
      EXPECT_GE(place.lon_deg, -180.0);
      EXPECT_LT(place.lon_deg, 180.0);
      EXPECT_LT(glm::distance(geo::ecef_from_geodetic(geo::kWgs84, place), frame.ecef_from_local(local)),
                2e-8);
      EXPECT_LT(glm::distance(frame.local_from_geodetic(place), local), 2e-8);
      EXPECT_LT(glm::distance(frame.local_from_ecef(frame.ecef_from_local(local)), local), 2e-8);
    }
  }
}

TEST(TangentFrame, AHeightIsThatAboveTheEllipsoid) {
  const TangentFrame frame(geo::kMars, -12.0, 77.0);
  for (const double height : {-8000.0, 0.0, 21'000.0}) {
    const double z = frame.z_at(120'000, -90'000, height);
    EXPECT_NEAR(frame.geodetic_from_local({120'000, -90'000, z}).h_m, height, 2e-6);
  }
}

/// Hills whose heights are known for every latitude and longitude, as steep as mountains.
double hills(double lat_deg, double lon_deg) {
  return 2000.0 + 1500.0 * std::sin(lat_deg * 100.0) * std::cos(lon_deg * 80.0);
}

/// How far the ground over posts, as sampled, is from the ground there.
double worst_height(double lon_deg, int passes_enough) {
  const TangentFrame frame(geo::kWgs84, 52.0, lon_deg);
  const GroundHeights ground = [&](std::span<const glm::dvec3> normals, std::span<float> heights) {
    for (std::size_t k = 0; k < normals.size(); ++k) {
      const geo::Geodetic at = geo::degrees_from_normal(normals[k]);
      heights[k] = static_cast<float>(hills(at.lat_deg, at.lon_deg));
    }
  };
  const PostRect rect{-40, -40, 81, 81, 1};
  const HeightGrid grid = sample_ground(frame, 2000.0, rect, ground, passes_enough > 1 ? 0.005 : 1e9);
  std::vector<float> heights(81 * 81);
  grid.posts(rect, heights);
  double worst = 0.0;
  for (int j = 0; j < 81; ++j) {
    for (int i = 0; i < 81; ++i) {
      const double x = (i - 40) * 2000.0, y = (j - 40) * 2000.0;
      const auto h = static_cast<double>(heights[static_cast<std::size_t>(j * 81 + i)]);
      const geo::Geodetic at = frame.geodetic_from_local({x, y, frame.z_at(x, y, h)});
      worst = std::max(worst, std::abs(h - hills(at.lat_deg, at.lon_deg)));
    }
  }
  return worst;
}

TEST(SampledGround, StandsWhereItsPostsAre) {
  EXPECT_LT(worst_height(10.0, 5), 0.05);
  EXPECT_LT(worst_height(-179.99, 5), 0.05);  // across the antimeridian
  EXPECT_GT(worst_height(10.0, 1), 0.2);      // without going back and forth it does not
}

TEST(HeightSource, IsBilinearBetweenPostsAndEndsAtItsEdge) {
  const HeightGrid grid(10.0, {-1, 0, 3, 2, 1}, {0, 10, 20, 100, 110, 140});
  EXPECT_DOUBLE_EQ(height_m(grid, -10, 0), 0);
  EXPECT_DOUBLE_EQ(height_m(grid, 0, 10), 110);
  EXPECT_DOUBLE_EQ(height_m(grid, 5, 5), (10 + 20 + 110 + 140) / 4.0);
  EXPECT_DOUBLE_EQ(height_m(grid, 10, 10), 140);
  EXPECT_DOUBLE_EQ(height_m(grid, 1e6, -1e6), 20);
}

}  // namespace
