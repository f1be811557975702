// H12: nothing that can be seen is culled; little that cannot is kept.

#include "globe/clipmap/culling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace {

using glm::dvec3;
using globe::clipmap::Frustum;
using globe::clipmap::Horizon;
using globe::geo::kWgs84;

/// Half the width of a patch: radians, 200 km to 2 m.
double random_half(std::mt19937_64& random) {
  return 0.03 * std::pow(1e-5, std::uniform_real_distribution<double>(0.0, 1.0)(random));
}

/// A patch of ground: points, and the sphere around them as the clipmap makes it.
struct Ground {
  std::vector<dvec3> points;
  dvec3 centre{0.0};
  double radius = 0;
  double highest = -1e300;
};

Ground random_ground(std::mt19937_64& random, const dvec3& u, double half, double exaggeration) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const dvec3 t1 = glm::normalize(glm::cross(u, dvec3(0.31, 0.62, 0.72)));
  const dvec3 t2 = glm::cross(u, t1);
  const double base = (-11000.0 + 20000.0 * unit(random)) * exaggeration;
  Ground ground;
  dvec3 low(1e300), high(-1e300);
  for (int k = 0; k < 16; ++k) {
    const dvec3 v = glm::normalize(u + t1 * (half * (2.0 * unit(random) - 1.0)) +
                                   t2 * (half * (2.0 * unit(random) - 1.0)));
    const double rough = std::min(half * kWgs84.a * 0.3, 2000.0) * (unit(random) - 0.5) * exaggeration;
    const double h = std::clamp(base + rough, -11000.0 * exaggeration, 9000.0 * exaggeration);
    ground.highest = std::max(ground.highest, h);
    ground.points.push_back(globe::geo::ecef_from_normal(kWgs84, v, h));
    low = glm::min(low, ground.points.back());
    high = glm::max(high, ground.points.back());
  }
  ground.centre = 0.5 * (low + high);
  for (const dvec3& p : ground.points)
    ground.radius = std::max(ground.radius, glm::distance(p, ground.centre));
  return ground;
}

/// True when the straight line from the camera to a point passes through the ellipsoid of a height.
bool hidden(double lowest_m, const dvec3& camera, const dvec3& point) {
  const dvec3 scale = 1.0 / dvec3(kWgs84.a + lowest_m, kWgs84.a + lowest_m, kWgs84.b() + lowest_m);
  const dvec3 from = camera * scale, along = point * scale - from;
  const double t = std::clamp(-glm::dot(from, along) / glm::dot(along, along), 0.0, 1.0);
  return t > 0.0 && t < 1.0 && glm::length(from + along * t) < 1.0;
}

struct Counts {
  std::size_t false_culls = 0, kept = 0, in_vain = 0, hidden = 0;
};

enum class Size { kAny, kAsDrawn };

/// @param size  kAsDrawn: as wide as the clipmap's patches are at that distance, an eighth of it or less
Counts count(std::mt19937_64& random, std::size_t cases, Size size, double exaggeration, double camera_low,
             double camera_high) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double lowest = -11000.0 * exaggeration;
  Counts counts;
  for (std::size_t k = 0; k < cases; ++k) {
    const dvec3 u = hard::random_direction(random);
    const double above = camera_low + std::pow(camera_high - camera_low, unit(random));
    const dvec3 camera = globe::geo::ecef_from_normal(kWgs84, u, above);
    // half of the ground anywhere, half of it around the camera's horizon
    const double horizon = std::acos(std::min(1.0, kWgs84.a / (kWgs84.a + std::max(above, 0.0) + 1.0)));
    const double away = k % 2 == 0 ? std::acos(1.0 - 2.0 * unit(random))
                                   : std::min(3.14, (horizon + 0.1) * 2.0 * unit(random));
    const dvec3 aside = glm::normalize(glm::cross(u, hard::random_direction(random)));
    const Ground ground =
        random_ground(random, glm::normalize(u * std::cos(away) + aside * std::sin(away)),
                      size == Size::kAny ? random_half(random) : std::min(away / 16.0, 0.1), exaggeration);
    const bool sees = Horizon(kWgs84, lowest, camera).sees(ground.centre, ground.radius, ground.highest);
    bool seen = false;
    for (const dvec3& p : ground.points) seen = seen || !hidden(lowest, camera, p);
    counts.false_culls += seen && !sees ? 1 : 0;
    counts.kept += sees ? 1 : 0;
    counts.in_vain += sees && !seen ? 1 : 0;
    counts.hidden += seen ? 0 : 1;
  }
  return counts;
}

std::string percent(std::size_t part, std::size_t of) {
  return hard::figure(100.0 * static_cast<double>(part) / static_cast<double>(of)) + " %";
}

TEST(H12, TheHorizonCullsNothingThatCanBeSeen) {
  std::mt19937_64 random(12);
  const std::size_t size = hard::full() ? 10'000'000 : 100'000;
  Counts counts = count(random, size / 2, Size::kAny, 1.0, -10000.0, 1e8);
  const Counts steep = count(random, size / 2, Size::kAny, 20.0, -10000.0, 1e8);
  counts.false_culls += steep.false_culls;
  hard::report("H12",
               "ground culled by the horizon though a point of it is in sight, " + std::to_string(size), "0",
               std::to_string(counts.false_culls));
  EXPECT_EQ(counts.false_culls, 0u);
  EXPECT_GT(counts.hidden, size / 20);
}

TEST(H12, FromAboveTheTerrainLittleIsKeptInVain) {
  std::mt19937_64 random(13);
  const std::size_t size = hard::full() ? 2'000'000 : 100'000;
  const Counts counts = count(random, size, Size::kAsDrawn, 1.0, 9000.0, 1e8);
  hard::report("H12", "kept by the horizon though hidden, of what is kept, camera above the terrain", "10 %",
               percent(counts.in_vain, counts.kept));
  EXPECT_LE(static_cast<double>(counts.in_vain), 0.1 * static_cast<double>(counts.kept));
}

/// The control culls by the ellipsoid itself, as if no ground lay below it.
TEST(H12, NegativeControlAnOccluderAtHeightZeroCullsWhatIsSeen) {
  std::mt19937_64 random(14);
  std::size_t false_culls = 0;
  for (int k = 0; k < 20000; ++k) {
    const dvec3 u = hard::random_direction(random);
    const dvec3 camera = globe::geo::ecef_from_normal(kWgs84, u, 2.0);
    const dvec3 aside = glm::normalize(glm::cross(u, hard::random_direction(random)));
    const Ground ground = random_ground(random, glm::normalize(u + aside * 0.04), random_half(random), 1.0);
    bool seen = false;
    for (const dvec3& p : ground.points) seen = seen || !hidden(-11000.0, camera, p);
    false_culls +=
        seen && !Horizon(kWgs84, 0.0, camera).sees(ground.centre, ground.radius, ground.highest) ? 1 : 0;
  }
  hard::report("H12", "negative control: the ellipsoid itself as occluder, 20000", "> 0",
               std::to_string(false_culls));
  EXPECT_GT(false_culls, 0u);
}

TEST(H12, TheFrustumCullsNothingInView) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::size_t size = hard::full() ? 10'000'000 : 100'000;
  std::size_t false_culls = 0, outside = 0;
  for (std::size_t k = 0; k < size; ++k) {
    const dvec3 forward = hard::random_direction(random);
    const dvec3 right = glm::normalize(glm::cross(forward, hard::random_direction(random)));
    const dvec3 up = glm::cross(right, forward);
    const double tan_y = std::pow(10.0, -3.0 + 3.3 * unit(random)),
                 tan_x = tan_y * (0.5 + 2.0 * unit(random));
    const Frustum frustum(forward, right, up, tan_x, tan_y);
    const dvec3 centre = hard::random_direction(random) * std::pow(10.0, 8.0 * unit(random));
    const double radius = glm::length(centre) * std::pow(10.0, -4.0 + 4.2 * unit(random));
    bool inside = false;
    for (int p = 0; p < 8; ++p) {
      const dvec3 point = centre + hard::random_direction(random) * (radius * (p == 0 ? 0.0 : 1.0));
      const double w = glm::dot(point, forward);
      inside = inside || (w > 0 && std::abs(glm::dot(point, right)) <= w * tan_x &&
                          std::abs(glm::dot(point, up)) <= w * tan_y);
    }
    const bool sees = frustum.sees(centre, radius);
    false_culls += inside && !sees ? 1 : 0;
    outside += sees ? 0 : 1;
  }
  hard::report("H12", "spheres culled by the frustum though a point is in view, " + std::to_string(size), "0",
               std::to_string(false_culls));
  EXPECT_EQ(false_culls, 0u);
  EXPECT_GT(outside, size / 4);
}

TEST(H12, BelowTheGroundAndAtTheCentreEverythingIsKept) {
  std::mt19937_64 random(16);
  for (const double height : {-kWgs84.a, -kWgs84.b(), -6e6, -2e5, -11000.5}) {
    for (int k = 0; k < 1000; ++k) {
      const dvec3 u = hard::random_direction(random);
      const dvec3 camera = height == -kWgs84.a
                               ? dvec3(0.0)
                               : globe::geo::surface_point(kWgs84, u) * (1.0 + height / kWgs84.b());
      const Horizon horizon(kWgs84, -11000.0, camera);
      EXPECT_TRUE(horizon.sees(globe::geo::ecef_from_normal(kWgs84, hard::random_direction(random), -11000.0),
                               10.0, -11000.0));
      EXPECT_TRUE(horizon.sees(dvec3(0.0), 0.0, 0.0));
    }
  }
}

}  // namespace
