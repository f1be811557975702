#include "globe/effects/atmosphere_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/accuracy/scattering_cases.h"

// The light of the air by tables against an integration that knows none: once-scattered light by quadrature
// in double precision, the rest by Monte Carlo (app/accuracy/scattering_reference.h).

namespace {

namespace accuracy = app::accuracy;
namespace effects = globe::effects;
using glm::dvec3;

const effects::AirModel kModel;

dvec3 drawn(const effects::AirTables& tables, const accuracy::ScatteringRay& ray, int panels,
            bool sparing = false) {
  return effects::air_radiance(kModel, tables,
                               {glm::vec3(ray.eye), glm::vec3(ray.direction), static_cast<float>(ray.from),
                                static_cast<float>(ray.to), glm::vec3(ray.sun)},
                               panels, sparing);
}

/// Worst relative error of a look's channels, and what it is less than the reference is sure of (95 %).
struct LookError {
  double seen = 0, beyond_interval = 0;
};

LookError error_of(const effects::AirTables& tables, const accuracy::ScatteringCase& look,
                   const accuracy::ScatteredLight& value) {
  const dvec3 truth = value.sum(), light = drawn(tables, look.ray, effects::kSkyPanels);
  LookError error;
  for (int channel = 0; channel < 3; ++channel) {
    const double off = std::abs(light[channel] - truth[channel]);
    error.seen = std::max(error.seen, off / truth[channel]);
    error.beyond_interval = std::max(error.beyond_interval, (off - value.interval[channel]) / truth[channel]);
  }
  return error;
}

TEST(Atmosphere, SkyLightIsWithinFivePercentOfAnIndependentIntegrationAtFiftyLooks) {
  const effects::AirTables tables = effects::air_tables(kModel);
  const auto cases = accuracy::scattering_cases();
  const auto values = accuracy::scattering_values();
  ASSERT_EQ(values.size(), cases.size());
  ASSERT_GE(cases.size(), 50u);
  double worst = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const LookError error = error_of(tables, cases[k], values[k]);
    EXPECT_LE(error.seen, 0.05) << cases[k].name;
    worst = std::max(worst, error.seen);
  }
  std::printf("worst: %.2f %%\n", 100.0 * worst);
}

TEST(Atmosphere, LooksDrawnByLotAreWithinFivePercentTooAsFarAsTheReferenceCanTell) {
  const effects::AirTables tables = effects::air_tables(kModel);
  const auto cases = accuracy::drawn_scattering_cases();
  const auto values = accuracy::drawn_scattering_values();
  ASSERT_EQ(values.size(), cases.size());
  int plainly = 0;
  double worst = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const LookError error = error_of(tables, cases[k], values[k]);
    EXPECT_LE(error.beyond_interval, 0.05) << cases[k].name;
    plainly += error.seen <= 0.05 ? 1 : 0;
    worst = std::max(worst, error.seen);
  }
  EXPECT_GE(plainly, 49);
  std::printf("%d of %zu within 5 %%, worst: %.2f %%\n", plainly, cases.size(), 100.0 * worst);
}

TEST(Atmosphere, HazeBeforeGroundIsWithinFivePercentWithTheSamplesOfAVertex) {
  const effects::AirTables tables = effects::air_tables(kModel);
  const auto cases = accuracy::scattering_cases();
  const auto values = accuracy::scattering_values();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (cases[k].name.find("ground") == std::string::npos) continue;
    const dvec3 truth = values[k].sum(), light = drawn(tables, cases[k].ray, effects::kHazePanels, true);
    const double brightest = std::max({truth.x, truth.y, truth.z});
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_LE(std::abs(light[channel] - truth[channel]), 0.05 * brightest)
          << cases[k].name << ", channel " << channel;
  }
}

// Ground at the limb lies beyond where the way to it comes lowest. With as many samples there as before it, a
// few kilometres against thousands, its haze was up to half too bright: a pale line along the limb.
TEST(Atmosphere, HazeBeforeTheLimbTakesNoLeapWhereTheWayToItIsLowest) {
  const effects::AirTables tables = effects::air_tables(kModel);
  const double ground = kModel.ground_km, top = ground + kModel.thickness_km;
  double worst = 0;
  for (const double eye_km : {20.0, 400.0, 5000.0}) {
    for (const double lowest_km : {0.1, 1.0, 4.0}) {
      const double radius = ground + eye_km, nearest = ground + lowest_km;
      const double lowest = std::sqrt(radius * radius - nearest * nearest);
      const double half_chord = std::sqrt(top * top - nearest * nearest);
      for (const double beyond_km : {-30.0, -1.0, 0.5, 5.0}) {
        for (const double sun_deg : {3.0, 25.0}) {  // above the level where the way is lowest
          const double along = sun_deg / 57.29577951308232;
          const double sine = nearest / radius, cosine = lowest / radius;
          const dvec3 direction(sine, 0.0, -cosine), up(cosine, 0.0, sine);
          const accuracy::ScatteringRay ray{dvec3(0.0, 0.0, radius), direction,
                                            std::max(lowest - half_chord, 0.0), lowest + beyond_km,
                                            direction * std::cos(along) + up * std::sin(along)};
          const dvec3 truth = drawn(tables, ray, 64), light = drawn(tables, ray, effects::kHazePanels, true);
          const double brightest = std::max({truth.x, truth.y, truth.z});
          for (int channel = 0; channel < 3; ++channel)
            worst = std::max(worst, std::abs(light[channel] - truth[channel]) / brightest);
        }
      }
    }
  }
  EXPECT_LE(worst, 0.05);
}

TEST(Atmosphere, AirOfSinglyScatteredLightFailsTheSameLooks) {
  effects::AirTableSizes sizes;
  sizes.orders = 1;
  const effects::AirTables tables = effects::air_tables(kModel, sizes);
  const auto cases = accuracy::scattering_cases();
  const auto values = accuracy::scattering_values();
  int wrong = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const dvec3 truth = values[k].sum(), light = drawn(tables, cases[k].ray, effects::kSkyPanels);
    if (std::abs(light.z / truth.z - 1.0) > 0.05) ++wrong;
  }
  EXPECT_GT(wrong, 40);
}

// What the committed values say is what the reference computes.
TEST(Atmosphere, ReferenceOfOneLookComesOutAsCommitted) {
  const auto cases = accuracy::scattering_cases();
  const auto values = accuracy::scattering_values();
  const auto light = accuracy::scattered_light(kModel, cases.front().ray, 0.03, 20000, 99);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(light.once[channel] / values.front().once[channel], 1.0, 1e-3);
    EXPECT_NEAR(light.again[channel], values.front().again[channel],
                2.0 * (light.interval[channel] + values.front().interval[channel]));
  }
}

}  // namespace
