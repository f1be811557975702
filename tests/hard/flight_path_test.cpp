// H20: the camera's path between any two places and heights.

#include "globe/scene/flight_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "globe/geo/ellipsoid.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace {

using glm::dvec3;
using globe::scene::FlightPath;
using globe::scene::PathPoint;

constexpr double kRadius = 6371008.8;
constexpr double kEndError = 1e-9;     ///< radians of the place, share of the height
constexpr double kMirrorError = 1e-6;  ///< the same two, along the way
constexpr double kSpeedError = 0.01;

double angle_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Pairs of places: anywhere, log-uniformly near to each other, the same, antipodal and nearly so.
struct FlightPair {
  dvec3 from, to;
  double from_height, to_height;
};

FlightPair random_pair(std::mt19937_64& random, std::size_t k) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  FlightPair pair;
  pair.from = hard::random_direction(random);
  const dvec3 aside = glm::normalize(glm::cross(pair.from, hard::random_direction(random)));
  const double small = std::pow(10.0, -9.0 + 9.4 * unit(random));
  switch (k % 5) {
    case 0:
      pair.to = hard::random_direction(random);
      break;
    case 1:
      pair.to = glm::normalize(pair.from + aside * small);
      break;
    case 2:
      pair.to = pair.from;
      break;
    case 3:
      pair.to = -pair.from;
      break;
    default:
      pair.to = glm::normalize(-pair.from + aside * small);
  }
  pair.from_height = std::pow(10.0, 8.0 * unit(random));
  pair.to_height = std::pow(10.0, 8.0 * unit(random));
  return pair;
}

FlightPath path_of(const FlightPair& p) {
  return {p.from, p.from_height, p.to, p.to_height, kRadius, 30.0, -15.0};
}
FlightPath reverse_of(const FlightPair& p) {
  return {p.to, p.to_height, p.from, p.from_height, kRadius, 30.0, -15.0};
}

bool is_finite(const PathPoint& p) {
  return std::isfinite(p.u.x + p.u.y + p.u.z) && std::isfinite(p.height_m) && std::isfinite(p.pitch_deg) &&
         std::isfinite(p.heading_deg) && p.height_m > 0.0;
}

TEST(H20, PathsAreFiniteMeetTheirEndsAndMirrorTheirReverse) {
  std::mt19937_64 random(20);
  const std::size_t size = hard::cases(100'000);
  std::size_t not_finite = 0;
  double end_angle = 0, end_height = 0, mirror_angle = 0, mirror_height = 0;
  for (std::size_t k = 0; k < size; ++k) {
    const FlightPair pair = random_pair(random, k);
    const FlightPath path = path_of(pair), reverse = reverse_of(pair);
    for (const double t : {0.0, 1e-9, 0.07, 0.15, 0.31, 0.5, 0.77, 0.93, 1.0 - 1e-9, 1.0}) {
      const PathPoint at = path.at(t);
      not_finite += is_finite(at) ? 0 : 1;
      const PathPoint back = reverse.at(1.0 - t);
      mirror_height = std::max(mirror_height, std::abs(std::log(back.height_m / at.height_m)));
      // seen from the height there: an error of the place matters as a share of it
      const double metres = angle_between(at.u, back.u) * kRadius;
      mirror_angle = std::max(mirror_angle, metres / std::max(at.height_m, 1.0));
    }
    for (const bool end : {false, true}) {
      const PathPoint at = path.at(end ? 1.0 : 0.0);
      end_angle = std::max(end_angle, angle_between(at.u, end ? pair.to : pair.from));
      end_height =
          std::max(end_height, std::abs(at.height_m / (end ? pair.to_height : pair.from_height) - 1.0));
    }
  }
  hard::report("H20", "points of a path with NaN or no height, " + std::to_string(10 * size), "0",
               std::to_string(not_finite));
  hard::report("H20", "ends of a path: place in radians, height as a share", "1e-9",
               hard::figure(end_angle) + ", " + hard::figure(end_height));
  hard::report("H20", "reverse against mirror: place in heights, logarithm of the height", "1e-6",
               hard::figure(mirror_angle) + ", " + hard::figure(mirror_height));
  EXPECT_EQ(not_finite, 0u);
  EXPECT_LE(end_angle, kEndError);
  EXPECT_LE(end_height, kEndError);
  EXPECT_LE(mirror_angle, kMirrorError);
  EXPECT_LE(mirror_height, kMirrorError);
}

/// Van Wijk and Nuij's speed of the picture: sqrt(dw^2 / rho^2 + rho^2 du^2) / w, u the ground covered.
double perceived_speed(const FlightPath& path, double t, double dt) {
  constexpr double kRho = 1.4;
  const PathPoint a = path.at(t), b = path.at(t + dt);
  const double w = std::sqrt(a.height_m * b.height_m);
  const double zoom = std::log(b.height_m / a.height_m) / kRho;
  const double pan = kRho * angle_between(a.u, b.u) * kRadius / w;
  return std::hypot(zoom, pan) / dt;
}

TEST(H20, SpeedIsConstantBetweenTheEasedEnds) {
  std::mt19937_64 random(21);
  const std::size_t size = hard::cases(20'000);
  double zoom_only = 0, general = 0;
  for (std::size_t k = 0; k < size; ++k) {
    FlightPair pair = random_pair(random, k);
    const bool zoom = k % 5 == 2;
    if (zoom && std::abs(std::log(pair.from_height / pair.to_height)) < 0.1) continue;
    const FlightPath path = path_of(pair);
    double least = 1e300, most = 0;
    for (double t = 0.16; t < 0.835; t += 0.0517) {
      const double speed = zoom ? std::abs(std::log(path.at(t + 1e-4).height_m / path.at(t).height_m)) / 1e-4
                                : perceived_speed(path, t, 1e-4);
      least = std::min(least, speed);
      most = std::max(most, speed);
    }
    double& worst = zoom ? zoom_only : general;
    worst = std::max(worst, most / least - 1.0);
  }
  hard::report("H20", "logarithmic speed between the eased ends, zooms", "1 %",
               hard::figure(100 * zoom_only) + " %");
  hard::report("H20", "speed of the picture between the eased ends, any path", "1 %",
               hard::figure(100 * general) + " %");
  EXPECT_LE(zoom_only, kSpeedError);
  EXPECT_LE(general, kSpeedError);
}

TEST(H20, BetweenAntipodesThePathLeadsOverTheNorthPole) {
  const dvec3 from = globe::geo::normal_from_degrees(-20, 30);
  const FlightPath path(from, 1000, -from, 1000, kRadius, 0, -20);
  double northmost = -1;
  for (double t = 0; t <= 1.0; t += 1e-4) northmost = std::max(northmost, path.at(t).u.z);
  EXPECT_GT(northmost, 1 - 1e-6);
  const FlightPath poles({0, 0, 1}, 1000, {0, 0, -1}, 1000, kRadius, 0, -20);
  for (double t = 0.05; t < 1.0; t += 0.05) EXPECT_NEAR(poles.at(t).u.y, 0.0, 1e-12);
  EXPECT_GT(poles.at(0.5).u.x, 0.999);
}

TEST(H20, NegativeControlTheCommonLogarithmFails) {
  const double b = 1e9;  // what 1e7 : 1 leads to
  EXPECT_FALSE(std::isfinite(std::log(std::sqrt(b * b + 1.0) - b)));
  EXPECT_TRUE(std::isfinite(-std::asinh(b)));
  hard::report("H20", "negative control: log(sqrt(b^2 + 1) - b) at b = 1e9", "not finite", "-inf");
}

}  // namespace
