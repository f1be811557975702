#include "globe/planet/trixels.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace globe::planet {
namespace {

htm::Trixel one_by_one(double lat_deg, double lon_deg, int level) {
  return htm::trixel_by_walk(geo::normal_from_degrees(lat_deg, lon_deg), level);
}

TEST(TrixelsFromDegrees, AreThoseOfTheWalkOneByOne) {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> latitude(-90, 90), longitude(-540, 540);
  for (const std::size_t count : {0UL, 1UL, 7UL, 8UL, 513UL, 40'000UL}) {
    std::vector<double> lat_deg(count), lon_deg(count);
    for (std::size_t k = 0; k < count; ++k) {
      lat_deg[k] = k % 7 == 0 ? 45.0 * static_cast<double>(random() % 5) - 90.0 : latitude(random);
      lon_deg[k] = k % 5 == 0 ? 45.0 * static_cast<double>(random() % 17) - 360.0 : longitude(random);
    }
    std::vector<htm::Trixel> found(count);
    const std::size_t walked = trixels_from_degrees(lat_deg, lon_deg, 20, found);
    EXPECT_LE(walked, count / 3 + 1);  // the multiples of 45 degrees lie on sides
    for (std::size_t k = 0; k < count; ++k)
      ASSERT_EQ(found[k], one_by_one(lat_deg[k], lon_deg[k], 20)) << lat_deg[k] << ' ' << lon_deg[k];
  }
}

TEST(TrixelsFromDegrees, DoNotDependOnTheNumberOfThreads) {
  constexpr std::size_t kCount = 100'000;
  std::vector<double> lat_deg(kCount), lon_deg(kCount);
  for (std::size_t k = 0; k < kCount; ++k) {
    lat_deg[k] = static_cast<double>(k % 181) - 90.0;
    lon_deg[k] = static_cast<double>(k) * 0.01;
  }
  std::vector<htm::Trixel> alone(kCount), together(kCount);
  std::uint64_t exact_alone = 0, exact_together = 0;
  std::size_t walked_alone = 0;
  {
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    walked_alone = trixels_from_degrees(lat_deg, lon_deg, htm::kMaxLevel, alone, &exact_alone);
  }
  EXPECT_EQ(trixels_from_degrees(lat_deg, lon_deg, htm::kMaxLevel, together, &exact_together), walked_alone);
  EXPECT_EQ(alone, together);
  EXPECT_EQ(exact_alone, exact_together);
  EXPECT_GT(exact_alone, 0u);  // the equator is among them
}

RC_GTEST_PROP(TrixelsFromDegrees, AgreeAtEveryLevelWithTheWalk, ()) {
  const int level = *rc::gen::inRange(0, htm::kMaxLevel + 1);
  // Multiples of 2^-20 degrees and of 1.5 degrees: the latter meet many sides.
  const double step = *rc::gen::element(0x1p-20, 1.5);
  const auto half_turn = static_cast<int>(90.0 / step);
  const double lat = *rc::gen::inRange(-half_turn, half_turn + 1) * step;
  const double lon = *rc::gen::inRange(-2 * half_turn, 2 * half_turn + 1) * step;
  const std::vector<double> lat_deg(9, lat), lon_deg(9, lon);
  std::vector<htm::Trixel> found(9);
  trixels_from_degrees(lat_deg, lon_deg, level, found);
  for (const htm::Trixel& t : found) RC_ASSERT(t == one_by_one(lat, lon, level));
  RC_ASSERT(htm::trixel_at(geo::normal_from_degrees(lat, lon), level) == found[0]);
}

}  // namespace
}  // namespace globe::planet
