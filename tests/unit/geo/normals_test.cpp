#include "globe/geo/normals.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace globe::geo {
namespace {

/// How many of the places have other bits together than one by one.
std::size_t different(const std::vector<double>& lat_deg, const std::vector<double>& lon_deg) {
  const std::size_t count = lat_deg.size();
  std::vector<double> x(count), y(count), z(count);
  normals_from_degrees(lat_deg, lon_deg, x, y, z);
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3 u = normal_from_degrees(lat_deg[k], lon_deg[k]);
    wrong += bits(u.x) != bits(x[k]) || bits(u.y) != bits(y[k]) || bits(u.z) != bits(z[k]);
  }
  return wrong;
}

TEST(NormalsFromDegrees, HaveTheBitsOfNormalFromDegrees) {
  std::mt19937_64 random(35);
  std::uniform_real_distribution<double> latitude(-90, 90), longitude(-400, 400);
  for (const std::size_t count : {0UL, 1UL, 2UL, 7UL, 8UL, 9UL, 511UL, 512UL, 513UL, 20'000UL}) {
    std::vector<double> lat_deg(count), lon_deg(count);
    for (std::size_t k = 0; k < count; ++k) {
      lat_deg[k] = k % 5 == 0 ? 45.0 * static_cast<double>(random() % 5) - 90.0 : latitude(random);
      lon_deg[k] = k % 3 == 0 ? 45.0 * static_cast<double>(random() % 33) - 720.0 : longitude(random);
    }
    EXPECT_EQ(different(lat_deg, lon_deg), 0u) << count;
  }
}

TEST(NormalsFromDegrees, TakeLongitudesOfAnySizeAmongOthers) {
  std::vector<double> lat_deg(600, 12.5), lon_deg(600, -33.0);
  for (const double lon : {0x1p40, 0x1p41, -0x1p52 - 1, 1e17, -1e300, 1.7976931348623157e308}) {
    lon_deg[300] = lon;
    EXPECT_EQ(different(lat_deg, lon_deg), 0u) << lon;
    EXPECT_EQ(normal_from_degrees(12.5, lon), normal_from_degrees(12.5, std::remainder(lon, 360.0))) << lon;
  }
}

RC_GTEST_PROP(NormalsFromDegrees, AreTheSameAWholeTurnAway, ()) {
  // A multiple of 2^-38 degrees, so that whole turns are exact.
  const double lon =
      std::ldexp(static_cast<double>(*rc::gen::inRange<std::int64_t>(-(90LL << 38), 90LL << 38)), -38);
  const double lat =
      std::ldexp(static_cast<double>(*rc::gen::inRange<std::int64_t>(-(90LL << 38), 90LL << 38)), -38);
  const double turns = 360.0 * *rc::gen::inRange(-9, 9);
  RC_ASSERT(normal_from_degrees(lat, lon) == normal_from_degrees(lat, lon + turns));
  RC_ASSERT(different({lat, lat}, {lon, lon + turns}) == 0u);
}

}  // namespace
}  // namespace globe::geo
