// E4: waves are the sum of sinusoids that a scene asks for, in C++ and in the shaders' own code, against a
// reference in double precision that knows nothing of either.

#include "globe/effects/waves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <tuple>

#include "globe/geo/ellipsoid.h"
#include "tests/hard/table.h"

namespace {
namespace shader {
using namespace glm;
#include "shaders/lib/waves.glsl"

// Used by the shaders alone.
[[maybe_unused]] const auto kUnused = std::make_tuple(&mesh_share, &pixel_share, &shoal_share);
}  // namespace shader
}  // namespace

namespace globe::effects {
namespace {

using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;

const geo::Geodetic kReference{-43.0, -109.0, 0.0};

/// Round space: the ellipsoid scaled to a sphere of its mean radius.
long double angle_between(const dvec3& a, const dvec3& b) {
  const dvec3 across = glm::cross(a, b);
  return std::atan2(static_cast<long double>(glm::length(across)), static_cast<long double>(glm::dot(a, b)));
}

/// The sum as the header says it, from bearings alone.
double reference_height(const std::vector<Wave>& waves, const dvec3& foot, double time_s) {
  const double r = geo::kWgs84.mean_radius();
  const dvec3 rounding(r / geo::kWgs84.a, r / geo::kWgs84.a, r / geo::kWgs84.b());
  const geo::LocalFrame frame = geo::local_frame(kReference.lat_deg, kReference.lon_deg);
  const dvec3 at = glm::normalize(geo::ecef_from_geodetic(geo::kWgs84, kReference) * rounding);
  long double sum = 0;
  for (const Wave& wave : waves) {
    const double b = wave.from_deg * kPi / 180.0;
    const dvec3 bearing = (frame.north * std::cos(b) + frame.east * std::sin(b)) * rounding;
    const dvec3 source = glm::normalize(bearing - at * glm::dot(at, bearing));
    const long double k = 2.0L * kPi / wave.wavelength_m;
    const long double way = r * (angle_between(source, foot) - kPi / 2.0L);
    sum += wave.amplitude_m * std::cos(k * way - std::sqrt(kGravity * k) * time_s + wave.phase);
  }
  return static_cast<double>(sum);
}

dvec3 foot_of(const Sea& sea, double lat_deg, double lon_deg) {
  return sea.foot(geo::ecef_from_geodetic(geo::kWgs84, {lat_deg, lon_deg, 0.0}));
}

TEST(Waves, HeightsAreThoseOfTheReferenceAnywhereAndAnytime) {
  const Sea sea(geo::kWgs84, kReference, wind_waves(8.0, 240.0));
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> lat(-89.0, 89.0), lon(-180.0, 180.0), time(0.0, 1e5);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const dvec3 foot = foot_of(sea, lat(random), lon(random));
    const double t = time(random);
    worst = std::max(worst, std::abs(sea.height_m(foot, t) - reference_height(sea.waves(), foot, t)));
  }
  hard::report("E4", "heights of 36 waves against the sum in long double, 2000 places and times, metres",
               "1e-6", hard::figure(worst));
  EXPECT_LE(worst, 1e-6);
}

TEST(Waves, TheShadersSumAroundTheEyeIsTheSame) {
  const Sea sea(geo::kWgs84, kReference, wind_waves(8.0, 240.0));
  std::mt19937_64 random(72);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double reach : {100.0, 1000.0, 10000.0}) {
    double worst = 0;
    for (int k = 0; k < 500; ++k) {
      const double lat = -43.0 + 10.0 * unit(random), lon = -109.0 + 10.0 * unit(random),
                   t = 1e4 * (unit(random) + 1);
      const dvec3 nadir = foot_of(sea, lat, lon);
      const dvec3 aside = glm::normalize(glm::cross(nadir, dvec3(unit(random), unit(random), unit(random))));
      const double away = reach * unit(random) / sea.radius_m();
      const dvec3 place = nadir * std::cos(away) + aside * std::sin(away);
      const glm::vec3 offset((place - nadir) * sea.radius_m());
      const float rise = glm::dot(offset, glm::vec3(nadir));
      float sum = 0;
      for (std::size_t w = 0; w < sea.waves().size(); ++w) {
        const Sea::Local local = sea.at(w, nadir, t);
        const float way =
            shader::wave_way(offset, glm::dot(offset, offset) - rise * rise, glm::vec3(local.along),
                             static_cast<float>(local.cotangent), static_cast<float>(sea.radius_m()));
        sum += static_cast<float>(sea.waves()[w].amplitude_m) *
               std::cos(static_cast<float>(2.0 * kPi / sea.waves()[w].wavelength_m) * way +
                        static_cast<float>(local.phase));
      }
      worst = std::max(worst, std::abs(double(sum) - reference_height(sea.waves(), place, t)));
    }
    hard::report(
        "E4", "the shaders' heights up to " + std::to_string(int(reach)) + " m from the eye's nadir, metres",
        reach > 1000.0 ? "0.1" : "0.003", hard::figure(worst));
    EXPECT_LE(worst, reach > 1000.0 ? 0.1 : 0.003) << reach;
  }
}

TEST(Waves, WayFromTheSourceIsOfThirdOrder) {
  const double r = geo::kWgs84.mean_radius();
  for (const double from_source : {0.3, 1.0, kPi / 2, 2.2}) {
    const dvec3 source(1, 0, 0), nadir(std::cos(from_source), std::sin(from_source), 0);
    const dvec3 along(-std::sin(from_source), std::cos(from_source), 0);
    for (const double away : {1e3, 1e4, 1e5}) {
      for (double turn = 0; turn < 6.3; turn += 0.3) {
        const dvec3 to = along * std::cos(turn) + dvec3(0, 0, 1) * std::sin(turn);
        const dvec3 place = nadir * std::cos(away / r) + to * std::sin(away / r);
        const double truth =
            r * static_cast<double>(angle_between(source, place) - angle_between(source, nadir));
        const glm::vec3 offset((place - nadir) * r);
        const double level = std::sin(away / r) * r;
        const float way = shader::wave_way(offset, float(level * level), glm::vec3(along),
                                           float(1.0 / std::tan(from_source)), float(r));
        EXPECT_NEAR(double(way), truth, away < 5e4 ? 0.01 : 6.0) << from_source << " " << away << " " << turn;
      }
    }
  }
}

TEST(Waves, DeepWaterWavesRunAsTheDispersionRelationSays) {
  EXPECT_NEAR(angular_frequency(100.0), std::sqrt(kGravity * 2.0 * kPi / 100.0), 1e-12);
  EXPECT_NEAR(deep_water_length(0.1), 156.13, 0.01);  // a swell of ten seconds
  for (const double length : {0.3, 10.0, 500.0})
    EXPECT_NEAR(deep_water_length(angular_frequency(length) / (2.0 * kPi)), length, 1e-9 * length);
}

TEST(Waves, ACrestMovesWithItsWavesSpeed) {
  const Sea sea(geo::kWgs84, kReference, {{1.0, 80.0, 0.0, 270.0}});
  const dvec3 here = foot_of(sea, kReference.lat_deg, kReference.lon_deg);
  const double speed = angular_frequency(80.0) * 80.0 / (2.0 * kPi);
  EXPECT_NEAR(sea.height_m(here, 0.0), 1.0, 1e-9);
  // From the west: ten seconds later the crest is farther east.
  const dvec3 east = geo::local_frame(kReference.lat_deg, kReference.lon_deg).east;
  const double away = 10.0 * speed / sea.radius_m();
  EXPECT_NEAR(sea.height_m(here * std::cos(away) + east * std::sin(away), 10.0), 1.0, 1e-6);
}

/// Significant height of Pierson and Moskowitz's fully grown sea: 0.21 U^2 / g.
TEST(Waves, AWindRaisesTheSeaThatPiersonAndMoskowitzSaw) {
  for (const double wind : {4.0, 8.0, 15.0, 25.0}) {
    double variance = 0, amplitudes = 0;
    const std::vector<Wave> waves = wind_waves(wind, 225.0);
    for (const Wave& wave : waves) {
      variance += 0.5 * wave.amplitude_m * wave.amplitude_m;
      amplitudes += wave.amplitude_m;
    }
    EXPECT_NEAR(4.0 * std::sqrt(variance) / (0.21 * wind * wind / kGravity), 1.0, 0.12) << wind;
    EXPECT_LT(slope_variance(waves), slope_variance(wind)) << wind;
    EXPECT_LE(waves.size(), 40u);
    EXPECT_LE(amplitudes, 40.0);
  }
  EXPECT_TRUE(wind_waves(0.0, 0.0).empty());
}

}  // namespace
}  // namespace globe::effects
