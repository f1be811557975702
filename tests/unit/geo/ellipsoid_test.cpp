#include "globe/geo/ellipsoid.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/base/error.h"
#include "globe/htm/midpoint.h"

namespace globe::geo {
namespace {

constexpr double kNanometre = 1e-9;
/// A few roundings of a coordinate of 6.4e6 m, which is 0.93 nm each.
constexpr double kEcefError = 4 * kNanometre;

Geodetic random_geodetic(std::mt19937_64& random, double h_limit) {
  std::uniform_real_distribution<double> lat(-90, 90), lon(-180, 180), h(-h_limit, h_limit);
  return {lat(random), lon(random), h(random)};
}

TEST(NormalFromDegrees, PutsTheQuartersExactlyOnTheAxes) {
  EXPECT_EQ(normal_from_degrees(0, 0), dvec3(1, 0, 0));
  EXPECT_EQ(normal_from_degrees(0, 90), dvec3(0, 1, 0));
  EXPECT_EQ(normal_from_degrees(0, 180), dvec3(-1, 0, 0));
  EXPECT_EQ(normal_from_degrees(0, -180), dvec3(-1, 0, 0));
  EXPECT_EQ(normal_from_degrees(0, 270), dvec3(0, -1, 0));
  EXPECT_EQ(normal_from_degrees(0, -90), dvec3(0, -1, 0));
  for (const double lon : {0.0, 12.5, -77.0, 180.0, 1e6}) {
    EXPECT_EQ(normal_from_degrees(90, lon), dvec3(0, 0, 1));
    EXPECT_EQ(normal_from_degrees(-90, lon), dvec3(0, 0, -1));
  }
}

TEST(NormalFromDegrees, LeavesNoNegativeZero) {
  for (const double lat : {-90.0, -0.0, 0.0, 90.0}) {
    for (double lon = -720; lon <= 720; lon += 90) {
      const dvec3 u = normal_from_degrees(lat, lon);
      for (int k = 0; k < 3; ++k) EXPECT_FALSE(u[k] == 0.0 && std::signbit(u[k])) << lat << ' ' << lon;
    }
  }
}

TEST(NormalFromDegrees, PutsFortyFiveDegreesOnTheMidpointsOfTheOctahedronsEdges) {
  const dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(normal_from_degrees(0, 45), htm::midpoint(x, y));
  EXPECT_EQ(normal_from_degrees(0, -225), htm::midpoint(-x, y));
  EXPECT_EQ(normal_from_degrees(45, 0), htm::midpoint(x, z));
  EXPECT_EQ(normal_from_degrees(-45, 270), htm::midpoint(-y, -z));
}

TEST(NormalFromDegrees, TakesLongitudesOfAnySize) {
  for (const double lon : {0.25, -179.5, 33.125})
    for (const double turns : {1.0, -1.0, 7.0, -1e6})
      EXPECT_EQ(normal_from_degrees(10.5, lon + 360 * turns), normal_from_degrees(10.5, lon));
}

TEST(DegreesFromNormal, InvertsNormalFromDegrees) {
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 20'000; ++trial) {
    const Geodetic g = random_geodetic(random, 0);
    const Geodetic back = degrees_from_normal(normal_from_degrees(g.lat_deg, g.lon_deg));
    // One rounding of the vector is 6e-15 degrees; longitude is that over cos(lat).
    EXPECT_NEAR(back.lat_deg, g.lat_deg, 4e-14);
    EXPECT_NEAR(std::remainder(back.lon_deg - g.lon_deg, 360.0) * std::cos(g.lat_deg * M_PI / 180), 0, 4e-14);
    EXPECT_GE(back.lon_deg, -180.0);
    EXPECT_LT(back.lon_deg, 180.0);
  }
}

TEST(DegreesFromNormal, NeverAnswers180) {
  EXPECT_EQ(degrees_from_normal({-1, 0.0, 0}).lon_deg, -180.0);
  EXPECT_EQ(degrees_from_normal({-1, -0.0, 0}).lon_deg, -180.0);
  EXPECT_EQ(degrees_from_normal({-1, 1e-300, 0}).lon_deg, -180.0);
  EXPECT_EQ(degrees_from_normal({0, 0, 2}).lat_deg, 90.0);
  EXPECT_EQ(degrees_from_normal({0, 0, 2}).lon_deg, 0.0);
}

TEST(SurfacePoint, HasTheNormalItWasMadeFromAndLiesOnTheEllipsoid) {
  std::mt19937_64 random(32);
  for (const Ellipsoid& e : {kWgs84, kMars, kMoon, Ellipsoid{1.0, 0.5}}) {
    for (int trial = 0; trial < 1000; ++trial) {
      const Geodetic g = random_geodetic(random, 0);
      const dvec3 u = normal_from_degrees(g.lat_deg, g.lon_deg);
      const dvec3 p = surface_point(e, u) / e.a;
      const double c = e.b() / e.a;
      EXPECT_NEAR(p.x * p.x + p.y * p.y + p.z * p.z / (c * c), 1.0, 2e-15);
      const dvec3 gradient = glm::normalize(dvec3{p.x, p.y, p.z / (c * c)});
      EXPECT_LE(glm::length(gradient - u), 1e-15);
    }
  }
}

TEST(SurfacePoint, IsExactOnTheAxes) {
  EXPECT_EQ(surface_point(kWgs84, {1, 0, 0}), dvec3(kWgs84.a, 0, 0));
  EXPECT_EQ(surface_point(kWgs84, {0, -1, 0}), dvec3(0, -kWgs84.a, 0));
  EXPECT_EQ(surface_point(kWgs84, {0, 0, 1}), dvec3(0, 0, kWgs84.b()));
  EXPECT_EQ(surface_point(kMoon, {0, 0, -1}), dvec3(0, 0, -kMoon.a));
}

TEST(EcefFromGeodetic, AgreesWithGeographicLib) {
  std::mt19937_64 random(33);
  for (const Ellipsoid& e : {kWgs84, kMars, kMoon}) {
    const GeographicLib::Geocentric theirs(e.a, e.f);
    for (int trial = 0; trial < 20'000; ++trial) {
      const Geodetic g = random_geodetic(random, 20e3);
      dvec3 expected;
      theirs.Forward(g.lat_deg, g.lon_deg, g.h_m, expected.x, expected.y, expected.z);
      EXPECT_LE(glm::distance(ecef_from_geodetic(e, g), expected), kEcefError);
    }
  }
}

TEST(GeodeticFromEcef, FlagsTheCentreAndNothingElse) {
  const Geodetic center = geodetic_from_ecef(kWgs84, {0, 0, 0});
  EXPECT_TRUE(center.at_center);
  EXPECT_EQ(center.lat_deg, 90.0);
  EXPECT_EQ(center.h_m, -kWgs84.b());
  EXPECT_FALSE(geodetic_from_ecef(kWgs84, {0, 0, 1e-9}).at_center);
}

TEST(GeodeticFromEcef, IsExactAtPolesAndEquator) {
  const Geodetic north = geodetic_from_ecef(kWgs84, {0, 0, kWgs84.b() + 100});
  EXPECT_EQ(north.lat_deg, 90.0);
  EXPECT_NEAR(north.h_m, 100, kEcefError);
  const Geodetic equator = geodetic_from_ecef(kWgs84, {-kWgs84.a, 0, 0});
  EXPECT_EQ(equator.lat_deg, 0.0);
  EXPECT_EQ(equator.lon_deg, -180.0);
  EXPECT_NEAR(equator.h_m, 0, kEcefError);
}

TEST(MakeEllipsoid, RefusesWhatIsNone) {
  for (const auto& [a, f] :
       {std::pair{0.0, 0.0}, {-1.0, 0.0}, {NAN, 0.0}, {1.0, 1.0}, {1.0, NAN}, {INFINITY, 0.0}, {1e9, -1e308}})
    EXPECT_THROW(make_ellipsoid(a, f), UsageError) << a << ' ' << f;
  EXPECT_EQ(make_ellipsoid(kWgs84.a, kWgs84.f), kWgs84);
  EXPECT_GT(make_ellipsoid(1.0, -0.1).b(), 1.0);
}

TEST(LocalFrame, IsRightHandedAndPointsNorthAndUp) {
  std::mt19937_64 random(34);
  for (int trial = 0; trial < 1000; ++trial) {
    const Geodetic g = random_geodetic(random, 0);
    const LocalFrame frame = local_frame(g.lat_deg, g.lon_deg);
    EXPECT_LE(glm::distance(glm::cross(frame.east, frame.north), frame.up), 1e-15);
    EXPECT_GT(frame.north.z, 0.0);
    EXPECT_EQ(frame.east.z, 0.0);
  }
  EXPECT_EQ(look_direction(local_frame(0, 0), 90, 0), dvec3(0, 1, 0));
  EXPECT_EQ(look_direction(local_frame(0, 0), 123, -90), dvec3(-1, 0, 0));
}

TEST(RayEllipsoid, MeetsTheSurfaceWhereItIs) {
  EXPECT_NEAR(ray_ellipsoid(kWgs84, 0, {2 * kWgs84.a, 0, 0}, {-1, 0, 0}), kWgs84.a, 1e-8);
  EXPECT_NEAR(ray_ellipsoid(kWgs84, 1000, {0, 0, 1e7}, {0, 0, -1}), 1e7 - kWgs84.b() - 1000, 1e-8);
  EXPECT_LT(ray_ellipsoid(kWgs84, 0, {2 * kWgs84.a, 0, 0}, {1, 0, 0}), 0);
  EXPECT_LT(ray_ellipsoid(kWgs84, 0, {2 * kWgs84.a, 0, 0}, {0, 1, 0}), 0);
  EXPECT_NEAR(ray_ellipsoid(kWgs84, 0, {0, 0, 0}, {0, 1, 0}), kWgs84.a, 1e-8);
}

}  // namespace
}  // namespace globe::geo
