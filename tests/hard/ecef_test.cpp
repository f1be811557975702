// H22: geodetic to Earth-fixed coordinates and back, against quadruple precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>

#include "globe/geo/ellipsoid.h"
#include "tests/hard/quad.h"
#include "tests/hard/table.h"

namespace {

using globe::geo::dvec3;
using globe::geo::Ellipsoid;
using globe::geo::Geodetic;

using hard::quad;
using hard::square_root;

using hard::kNanometre;
constexpr double kEcefError = 10 * kNanometre;
constexpr double kFarUlps = 4;

/// Distance in metres between a point and the quadruple value of geodetic coordinates.
double distance_m(const Ellipsoid& e, const dvec3& point, const Geodetic& g) {
  const auto [sin_lat, cos_lat] = hard::quad_sine_cosine(g.lat_deg);
  const auto [sin_lon, cos_lon] = hard::quad_sine_cosine(g.lon_deg);
  const quad f = e.f;
  const quad e2 = f * (2 - f);
  const quad n = e.a / square_root(1 - e2 * sin_lat * sin_lat);
  const quad dx = (n + g.h_m) * cos_lat * cos_lon - point.x;
  const quad dy = (n + g.h_m) * cos_lat * sin_lon - point.y;
  const quad dz = (n * (1 - e2) + g.h_m) * sin_lat - point.z;
  return std::sqrt(static_cast<double>(dx * dx + dy * dy + dz * dz));
}

double ulp(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()) - x; }

/// The unit in the last place is that of the distance from the centre: longitude in degrees alone is rounded
/// by 2.5e-16 rad near 180, which can be more than 4 units of the largest of three like coordinates.
double allowed_m(const dvec3& ecef, double h_m) {
  return h_m <= 1e6 ? kEcefError : std::max(kEcefError, kFarUlps * ulp(glm::length(ecef)));
}

Geodetic random_geodetic(std::mt19937_64& random, std::size_t k, double h_m) {
  std::uniform_real_distribution<double> lat(-90, 90), lon(-180, 180);
  Geodetic g{lat(random), lon(random), h_m};
  if (k % 16 == 0) g.lat_deg = k % 32 == 0 ? 90 : -90;
  if (k % 16 == 1) g.lat_deg = 0;
  if (k % 16 == 2) g.lon_deg = 90.0 * static_cast<double>(random() % 4) - 180.0;
  if (k % 16 == 3) g.lat_deg = 90 - std::ldexp(1.0, -static_cast<int>(random() % 40));
  return g;
}

struct Worst {
  double there_m = 0, back_m = 0;  ///< to ECEF, and from it
  double share = 0;                ///< of what is allowed
};

template <typename Height>
Worst worst_of(const Ellipsoid& e, std::size_t count, Height height) {
  std::mt19937_64 random(80);
  Worst worst;
  for (std::size_t k = 0; k < count; ++k) {
    const Geodetic g = random_geodetic(random, k, height(random));
    const dvec3 ecef = globe::geo::ecef_from_geodetic(e, g);
    const double there = distance_m(e, ecef, g);
    const double back = distance_m(e, ecef, globe::geo::geodetic_from_ecef(e, ecef));
    worst.there_m = std::max(worst.there_m, there);
    worst.back_m = std::max(worst.back_m, back);
    worst.share = std::max(worst.share, std::max(there, back) / allowed_m(ecef, g.h_m));
  }
  return worst;
}

std::string seen(const Worst& w) {
  return hard::figure(w.there_m / kNanometre) + " nm there, " + hard::figure(w.back_m / kNanometre) +
         " nm back";
}

TEST(H22, WithinTwentyKilometresOfTheSurfaceTheErrorIsBelow10Nanometres) {
  const auto height = [](std::mt19937_64& random) {
    return std::uniform_real_distribution<double>(-20e3, 20e3)(random);
  };
  const Worst w = worst_of(globe::geo::kWgs84, hard::cases(1'000'000), height);
  hard::report("H22", "geodetic <-> ECEF against __float128, |h| <= 20 km", "10 nm", seen(w));
  EXPECT_LE(w.there_m, kEcefError);
  EXPECT_LE(w.back_m, kEcefError);
}

TEST(H22, FartherOutTheErrorIsBelow4UnitsInTheLastPlace) {
  const auto height = [](std::mt19937_64& random) {
    return std::pow(10.0, std::uniform_real_distribution<double>(0, 8)(random));
  };
  for (const Ellipsoid& e : {globe::geo::kWgs84, globe::geo::kMars, globe::geo::kMoon}) {
    const Worst w = worst_of(e, hard::cases(300'000), height);
    hard::report("H22",
                 "h from 1 m to 1e8 m, a = " + hard::figure(e.a) + ", share of 10 nm to 1e6 m, 4 ulp beyond",
                 "<= 1", hard::figure(w.share) + " (" + seen(w) + ")");
    EXPECT_LE(w.share, 1.0);
  }
}

TEST(H22, TheCentreIsFlagged) {
  const Geodetic center = globe::geo::geodetic_from_ecef(globe::geo::kWgs84, {0, 0, 0});
  hard::report("H22", "the centre is flagged", "yes", center.at_center ? "yes" : "no");
  EXPECT_TRUE(center.at_center);
  EXPECT_TRUE(std::isfinite(center.lat_deg) && std::isfinite(center.lon_deg) && std::isfinite(center.h_m));
}

}  // namespace
