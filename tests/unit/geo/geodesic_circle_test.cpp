#include "globe/geo/geodesic_circle.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace globe::geo {
namespace {

constexpr double kSeriesError = 5e-15;  // radians

TEST(GeodesicCircle, PassesWhereGeodesicsEnd) {
  for (const Ellipsoid& ellipsoid : {kWgs84, kMars, Ellipsoid{1e6, -0.02}, Ellipsoid{1.0, 0.1}}) {
    const GeographicLib::Geodesic geodesic(ellipsoid.a, ellipsoid.f);
    for (const Geodetic& center : {Geodetic{48, 16}, Geodetic{90, 0}, Geodetic{0, 180}, Geodetic{-89.9, 3}}) {
      for (const double part : {1e-9, 0.01, 1.0, 2.9}) {
        const GeodesicCircle circle(ellipsoid, center, part * ellipsoid.a);
        for (int k = 0; k < 100; ++k) {
          const double azimuth_deg = 3.6 * k + 0.123;
          double lat = 0, lon = 0;
          geodesic.Direct(center.lat_deg, center.lon_deg, azimuth_deg, part * ellipsoid.a, lat, lon);
          const dvec3 expected = normal_from_degrees(lat, lon);
          const dvec3 seen = circle.at(azimuth_deg * std::numbers::pi / 180.0);
          ASSERT_LT(glm::distance(seen, expected), kSeriesError) << part << " " << ellipsoid.f << " " << k;
        }
      }
    }
  }
}

TEST(GeodesicCircle, BendBoundsTheSecondDerivative) {
  const GeodesicCircle circle(kWgs84, {37, -12}, 5e6);
  constexpr double kStep = 1e-3;
  for (int k = 0; k < 60; ++k) {
    const double azimuth = 0.1 * k;
    const dvec3 second =
        (circle.at(azimuth + kStep) - 2.0 * circle.at(azimuth) + circle.at(azimuth - kStep)) /
        (kStep * kStep);
    EXPECT_LE(glm::length(second), circle.bend() * (1.0 + 1e-6));
  }
  EXPECT_LT(circle.bend(), 1.5 * std::sin(5e6 / 6371e3));  // sqrt(2) times that of a circle
}

TEST(GeodesicCircle, GeodesicsAreShortestWithinTheInjectivityRadius) {
  for (const Ellipsoid& ellipsoid : {kWgs84, Ellipsoid{1e6, -0.02}, Ellipsoid{1.0, 0.1}}) {
    const GeographicLib::Geodesic geodesic(ellipsoid.a, ellipsoid.f);
    const double radius = injectivity_radius_m(ellipsoid);
    for (double lat = -90; lat <= 90; lat += 7.5) {
      for (double azimuth = 0; azimuth < 360; azimuth += 11) {
        double lat2 = 0, lon2 = 0;
        geodesic.Direct(lat, 0, azimuth, radius, lat2, lon2);
        EXPECT_NEAR(geodesic_distance_m(ellipsoid, {lat, 0}, {lat2, lon2}), radius,
                    1e-13 * ellipsoid.a * 100);
      }
    }
  }
  // Beyond, not: along the Earth's equator.
  const double beyond_m = 1.001 * injectivity_radius_m(kWgs84);
  double lat2 = 0, lon2 = 0;
  GeographicLib::Geodesic(kWgs84.a, kWgs84.f).Direct(0, 0, 90, beyond_m, lat2, lon2);
  EXPECT_LT(geodesic_distance_m(kWgs84, {0, 0}, {lat2, lon2}), beyond_m - 1.0);
}

}  // namespace
}  // namespace globe::geo
