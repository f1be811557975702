#include "app/accuracy/scattering_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace app::accuracy {
namespace {

using glm::dvec3;

dvec3 direction(double elevation_deg, double azimuth_deg) {
  const double e = elevation_deg * std::numbers::pi / 180.0, a = azimuth_deg * std::numbers::pi / 180.0;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// What a case looks at: an angle over the level, a limb's height, or ground so far from below the eye.
enum class At { kElevation, kLimb, kGround };

ScatteringCase case_of(double eye_km, double sun_deg, At at, double value, double azimuth_deg) {
  static constexpr std::array kWords{"look, deg", "limb, km", "ground, km"};
  const dvec3 eye(0.0, 0.0, kModel.ground_km + eye_km);
  double elevation = value;
  if (at == At::kLimb) elevation = -std::acos((kModel.ground_km + value) / eye.z) * 180.0 / std::numbers::pi;
  if (at == At::kGround) {
    const double turn = value / kModel.ground_km;
    elevation = -std::atan2(eye.z - kModel.ground_km * std::cos(turn), kModel.ground_km * std::sin(turn)) *
                180.0 / std::numbers::pi;
  }
  char name[120];
  std::snprintf(name, sizeof name, "eye at %g km, sun %g deg high, %s %g, %g deg from the sun", eye_km,
                sun_deg, kWords[static_cast<std::size_t>(at)], value, azimuth_deg);
  return {name, scattering_ray(kModel, eye, direction(elevation, azimuth_deg), direction(sun_deg, 0.0))};
}

}  // namespace

std::vector<ScatteringCase> scattering_cases() {
  std::vector<ScatteringCase> cases;
  struct Look {
    double elevation, azimuth;
  };
  // Each height and each sun, the looks in turn.
  constexpr std::array<Look, 7> kLooks{{{80, 0}, {30, 180}, {1, 0}, {10, 90}, {0.3, 180}, {3, 45}, {45, 20}}};
  std::size_t turn = 0;
  for (const double eye_km : {0.002, 3.0, 12.0, 35.0}) {
    for (const double sun_deg : {60.0, 15.0, 2.0, 0.0, -3.0, -6.0}) {
      const Look& look = kLooks[turn++ % kLooks.size()];
      cases.push_back(case_of(eye_km, sun_deg, At::kElevation, look.elevation, look.azimuth));
    }
  }
  for (const double sun_deg : {1.0, -2.0, -5.0}) {  // dawn
    for (const Look& look : {Look{1, 0}, Look{5, 180}, Look{45, 90}})
      cases.push_back(case_of(0.002, sun_deg, At::kElevation, look.elevation, look.azimuth));
  }
  struct Place {
    double sun, value, azimuth;
  };
  for (const Place& p :
       {Place{60, 3, 0}, Place{60, 40, 90}, Place{10, 10, 180}, Place{10, 25, 0}, Place{-10, 3, 0},
        Place{-5, 25, 90}, Place{-19, 10, 0}, Place{-19, 50, 20}, Place{-24, 25, 0}, Place{0, 10, 90}})
    cases.push_back(case_of(400.0, p.sun, At::kLimb, p.value, p.azimuth));
  for (const Place& p : {Place{40, 5, 90}, Place{-30, 30, 0}, Place{-60, 10, 0}})
    cases.push_back(case_of(20000.0, p.sun, At::kLimb, p.value, p.azimuth));
  cases.push_back(case_of(12.0, 2.0, At::kGround, 100.0, 0.0));
  cases.push_back(case_of(400.0, 30.0, At::kGround, 300.0, 90.0));
  cases.push_back(case_of(400.0, 12.0, At::kGround, 1500.0, 180.0));
  cases.push_back(case_of(2000.0, 20.0, At::kGround, 2000.0, 180.0));
  return cases;
}

std::vector<ScatteringCase> drawn_scattering_cases() {
  std::mt19937_64 random(20261128);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  const auto log_between = [&](double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  };
  constexpr std::size_t kCases = 50;
  std::vector<ScatteringCase> cases;
  while (cases.size() < kCases) {
    const bool in_air = cases.size() % 2 == 0;
    const double eye_km = in_air ? log_between(0.002, 50.0) : log_between(150.0, 36000.0);
    const dvec3 eye(0.0, 0.0, kModel.ground_km + eye_km);
    double elevation;
    if (in_air) {
      elevation = cases.size() % 4 == 0 ? between(0.2, 6.0) : between(6.0, 90.0);
    } else {
      // From the limb's upper end down to ground seen at a slant.
      const double lowest_km = cases.size() % 4 == 1 ? between(2.0, 60.0) : -log_between(1.0, 1000.0);
      elevation = -std::acos((kModel.ground_km + lowest_km) / eye.z) * 180.0 / std::numbers::pi;
    }
    const dvec3 look = direction(elevation, 0.0);
    const ScatteringRay ray = scattering_ray(kModel, eye, look, look);
    const double lowest = std::clamp(-glm::dot(eye, look), ray.from, ray.to);
    const dvec3 up = glm::normalize(eye + look * lowest);
    const dvec3 east(0, 1, 0), north = glm::cross(up, east);
    const double sun_deg = cases.size() % 3 == 0 ? between(8.0, 90.0) : between(-8.0, 8.0);
    const dvec3 level = direction(sun_deg, between(0.0, 180.0));
    char name[120];
    std::snprintf(name, sizeof name, "drawn look %zu: eye at %.3g km, look %.3g deg, sun %.3g deg high there",
                  cases.size(), eye_km, elevation, sun_deg);
    cases.push_back(
        {name, scattering_ray(kModel, eye, look, north * level.x + east * level.y + up * level.z)});
  }
  return cases;
}

}  // namespace app::accuracy
