#include "globe/htm/polygon.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/complement.h"
#include "globe/htm/cover.h"
#include "tests/hard/directions.h"

namespace globe::htm {
namespace {

using geo::normal_from_degrees;
using hard::random_direction;
using Rings = Polygon::Rings;

Polygon::Ring ring(const std::vector<std::pair<double, double>>& lat_lon) {
  Polygon::Ring result;
  for (const auto& [lat, lon] : lat_lon) result.push_back(normal_from_degrees(lat, lon));
  return result;
}

/// A ring of corners at random distances around a direction.
Polygon::Ring star(std::mt19937_64& random, const dvec3& center, double radius_rad, int count) {
  std::uniform_real_distribution<double> part(0.2, 1.0);
  const dvec3 east = glm::normalize(glm::cross(center, dvec3(0.3, 0.5, 0.7)));
  const dvec3 north = glm::cross(center, east);
  Polygon::Ring result;
  for (int k = 0; k < count; ++k) {
    const double azimuth = 2 * M_PI * k / count, r = radius_rad * part(random);
    result.push_back(glm::normalize(std::cos(r) * center +
                                    std::sin(r) * (std::cos(azimuth) * east + std::sin(azimuth) * north)));
  }
  return result;
}

std::string refusal(const Rings& rings) {
  try {
    const Polygon polygon(rings);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Polygon, HoldsTheSmallerSideEitherWayAround) {
  Polygon::Ring square = ring({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  for (int turn = 0; turn < 2; ++turn) {
    const Polygon polygon(Rings{square});
    EXPECT_TRUE(polygon.contains(normal_from_degrees(15, 15)));
    EXPECT_FALSE(polygon.contains(normal_from_degrees(25, 15)));
    EXPECT_FALSE(polygon.contains(normal_from_degrees(-15, -165)));
    std::reverse(square.begin(), square.end());
  }
}

TEST(Polygon, OfEqualSidesTheLeftOneIsInside) {
  Polygon::Ring equator = ring({{0, 0}, {0, 120}, {0, -120}});
  EXPECT_TRUE(Polygon(Rings{equator}).contains(normal_from_degrees(80, 3)));
  EXPECT_FALSE(Polygon(Rings{equator}).contains(normal_from_degrees(-1e-9, 3)));
  std::reverse(equator.begin(), equator.end());
  EXPECT_TRUE(Polygon(Rings{equator}).contains(normal_from_degrees(-80, 3)));
  EXPECT_FALSE(Polygon(Rings{equator}).contains(normal_from_degrees(1e-9, 3)));
}

TEST(Polygon, WiderThanAHalfByAHairIsTheOtherSide) {
  const Polygon::Ring north_of_equator = ring({{1e-3, 0}, {1e-3, 120}, {1e-3, -120}});
  EXPECT_TRUE(Polygon(Rings{north_of_equator}).contains(normal_from_degrees(80, 3)));
  const Polygon::Ring south_of_equator = ring({{-1e-3, 0}, {-1e-3, 120}, {-1e-3, -120}});
  EXPECT_TRUE(Polygon(Rings{south_of_equator}).contains(normal_from_degrees(-80, 3)));
}

TEST(Polygon, EdgesAndCornersAreInside) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Polygon::Ring corners = star(random, random_direction(random), 0.3, 9);
    const Polygon polygon(Rings{corners});
    for (const dvec3& corner : corners) EXPECT_TRUE(polygon.contains(corner));
  }
  const Polygon octant(Rings{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  for (const double degrees : {0.0, 10.0, 45.0, 89.0}) {
    EXPECT_TRUE(octant.contains(normal_from_degrees(0, degrees)));
    EXPECT_TRUE(octant.contains(normal_from_degrees(degrees, 0)));
    EXPECT_TRUE(octant.contains(normal_from_degrees(degrees, 90)));
  }
  EXPECT_FALSE(octant.contains(normal_from_degrees(0, 90.0000001)));
}

TEST(Polygon, PoleAndAntimeridianAreOrdinary) {
  const Polygon cap(Rings{ring({{80, 0}, {80, 90}, {80, 180}, {80, -90}})});
  EXPECT_TRUE(cap.contains({0, 0, 1}));
  EXPECT_TRUE(cap.contains(normal_from_degrees(85, 123)));
  EXPECT_FALSE(cap.contains(normal_from_degrees(79, 45)));
  const Polygon strip(Rings{ring({{-5, 170}, {-5, -170}, {5, -170}, {5, 170}})});
  EXPECT_TRUE(strip.contains(normal_from_degrees(0, 180)));
  EXPECT_FALSE(strip.contains(normal_from_degrees(0, 0)));
}

TEST(Polygon, HolesAreOutsideAndTheirEdgesInside) {
  const auto outer = ring({{0, 0}, {0, 10}, {10, 10}, {10, 0}});
  const auto hole = ring({{4, 4}, {4, 6}, {6, 6}, {6, 4}});
  const Polygon polygon(Rings{outer, hole});
  EXPECT_FALSE(polygon.contains(normal_from_degrees(5, 5)));
  EXPECT_TRUE(polygon.contains(normal_from_degrees(3, 5)));
  EXPECT_TRUE(polygon.contains(hole[0]));
}

TEST(Polygon, SeveralAreUnitedEvenWhereTheyOverlap) {
  const std::vector<Rings> both{{ring({{0, 0}, {0, 10}, {10, 10}, {10, 0}})},
                                {ring({{5, 5}, {5, 15}, {15, 15}, {15, 5}})}};
  const Polygon polygon(both);
  for (const auto& [lat, lon] : {std::pair{2, 2}, std::pair{7, 7}, std::pair{12, 12}})
    EXPECT_TRUE(polygon.contains(normal_from_degrees(lat, lon)));
  EXPECT_FALSE(polygon.contains(normal_from_degrees(12, 2)));
}

TEST(Polygon, RefusalsNameTheEdges) {
  EXPECT_NE(refusal({ring({{0, 0}, {10, 10}, {0, 10}, {10, 0}})})
                .find("from corner 1 crosses the edge from corner 3"),
            std::string::npos);
  EXPECT_NE(refusal({ring({{0, 0}, {10, 10}})}).find("2 different corners"), std::string::npos);
  EXPECT_NE(refusal({ring({{0, 0}, {10, 10}, {0, 0}, {10, 10}, {0, 0}})}).find("2 different corners"),
            std::string::npos);
  EXPECT_NE(refusal({}).find("no corners"), std::string::npos);
  EXPECT_NE(refusal({ring({{0, 0}, {10, 10}, {0, 180}})}).find("opposite points"), std::string::npos);
  const auto outer = ring({{0, 0}, {0, 10}, {10, 10}, {10, 0}});
  EXPECT_NE(refusal({outer, ring({{5, 5}, {5, 15}, {6, 5}})}).find("ring 1 crosses"), std::string::npos);
}

TEST(Polygon, TouchingIsNoCrossing) {
  // Two triangles that share a corner; a hole that touches the outer ring at a corner.
  EXPECT_EQ(refusal({ring({{0, 0}, {5, 5}, {10, 0}, {10, 10}, {5, 5}, {0, 10}})}), "");
  EXPECT_EQ(refusal({ring({{0, 0}, {0, 10}, {10, 10}, {10, 0}}), ring({{0, 0}, {2, 4}, {4, 2}})}), "");
}

TEST(Polygon, RepeatedCornersChangeNothing) {
  const auto plain = ring({{0, 0}, {0, 10}, {10, 10}, {10, 0}});
  auto repeated = ring({{0, 0}, {0, 0}, {0, 10}, {10, 10}, {10, 10}, {10, 0}, {0, 0}});
  EXPECT_EQ(cover(Polygon(Rings{plain}), {7, false, 0}), cover(Polygon(Rings{repeated}), {7, false, 0}));
}

RC_GTEST_PROP(Polygon, IsTheSameFromAnyCornerAndEitherWay, (std::uint32_t seed)) {
  std::mt19937_64 random(seed);
  const double radius = std::ldexp(1.0, -static_cast<int>(random() % 20));
  Polygon::Ring corners = star(random, random_direction(random), radius, 5 + static_cast<int>(random() % 40));
  const int level = std::min(kMaxLevel, 4 + static_cast<int>(-std::log2(radius)));
  const Polygon polygon(Rings{corners});
  std::reverse(corners.begin(), corners.end());
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random() % corners.size()),
              corners.end());
  const Polygon other(Rings{corners});
  RC_ASSERT(cover(polygon, {level, false, 0}) == cover(other, {level, false, 0}));
  RC_ASSERT(cover(polygon, {level, true, 9}) == cover(other, {level, true, 9}));
}

RC_GTEST_PROP(Polygon, AgreesWithAnIndependentWindingCount, (std::uint32_t seed)) {
  std::mt19937_64 random(seed);
  const dvec3 center = random_direction(random);
  const Polygon::Ring corners = star(random, center, 0.5, 3 + static_cast<int>(random() % 60));
  const Polygon polygon(Rings{corners});
  for (int k = 0; k < 50; ++k) {
    const dvec3 u = glm::normalize(center + 0.5 * random_direction(random));
    double turn = 0;  // of the corners' azimuths around u
    for (std::size_t m = 0; m < corners.size(); ++m) {
      const dvec3 a = glm::cross(u, corners[m]), b = glm::cross(u, corners[(m + 1) % corners.size()]);
      turn += std::atan2(glm::dot(u, glm::cross(a, b)), glm::dot(a, b));
    }
    RC_ASSERT(polygon.contains(u) == (std::abs(turn) > M_PI));
  }
}

TEST(Polygon, ManyCornersTakeNoQuadraticTime) {
  // A coast of 200,000 corners: comparing all pairs of edges would take minutes.
  constexpr int kCorners = 200'000;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> jag(-1e-5, 1e-5);
  Polygon::Ring coast;
  for (int k = 0; k < kCorners; ++k) {
    const double azimuth = 2 * M_PI * k / kCorners;
    const double lat = 45.0 + 10.0 * std::cos(azimuth) * (1.0 + 0.1 * std::cos(40.0 * azimuth) + jag(random));
    coast.push_back(normal_from_degrees(lat, 20.0 * std::sin(azimuth)));
  }
  const Polygon polygon(Rings{coast});
  EXPECT_TRUE(polygon.contains(normal_from_degrees(45, 1)));
  EXPECT_FALSE(polygon.contains(normal_from_degrees(25, 1)));
  EXPECT_LE(cover(polygon, {20, false, 100}).size(), 100u);
  // And crossings of edges far apart in the list are still seen.
  std::swap(coast[1000], coast[120'000]);
  EXPECT_NE(refusal({coast}).find("crosses"), std::string::npos);
}

}  // namespace
}  // namespace globe::htm
