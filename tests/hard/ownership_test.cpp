// H5: a point belongs to exactly one trixel, and it is the one that exact signs name.

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/midpoint.h"
#include "globe/htm/predicates.h"
#include "globe/htm/trixel.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace {

using globe::geo::normal_from_degrees;
using globe::htm::child;
using globe::htm::child_corners;
using globe::htm::Corners;
using globe::htm::exact_orientation;
using globe::htm::kMaxLevel;
using globe::htm::Trixel;
using globe::htm::trixel_at;
using hard::dvec3;

/// The truth: the walk by exact signs alone, on the rounded corners; ties go to child 0, 1, 2, then the
/// middle.
Trixel true_owner(const dvec3& u, int level) {
  Trixel t = globe::htm::root_at(u);
  Corners c = globe::htm::corners(t);
  while (globe::htm::level(t) < level) {
    int k = 0;
    for (; k < 3; ++k) {
      const Corners inner = child_corners(c, k);
      if (exact_orientation(inner[1], inner[2], u) >= 0) break;
    }
    c = child_corners(c, k);
    t = child(t, k);
  }
  return t;
}

/// 6 vertices, 12 edge midpoints, 8 face centres, points of the three great circles.
std::vector<dvec3> special_points() {
  std::vector<dvec3> points;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) points.push_back(glm::normalize(dvec3{x, y, z}));
  for (int degree = 0; degree < 360; degree += 3) {
    const double a = degree * M_PI / 180;
    points.push_back({std::cos(a), std::sin(a), 0});
    points.push_back({std::cos(a), 0, std::sin(a)});
    points.push_back({0, std::cos(a), std::sin(a)});
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      dvec3 p{0, 0, 0};
      p[axis] = sign;
      points.push_back(p);
      points.push_back(globe::htm::midpoint(p, {p.y, p.z, p.x}));
      points.push_back(globe::htm::midpoint(p, {-p.y, -p.z, -p.x}));
    }
  return points;
}

/// Each point, and it with every component moved by -4 .. 4 units in the last place.
std::vector<dvec3> with_surroundings(const std::vector<dvec3>& points) {
  std::vector<dvec3> all;
  for (const dvec3& p : points)
    for (int x = -4; x <= 4; ++x)
      for (int y = -4; y <= 4; ++y)
        for (int z = -4; z <= 4; ++z)
          if (x == 0 || y == 0 || std::abs(x) == std::abs(z))
            all.push_back({hard::moved(p.x, x), hard::moved(p.y, y), hard::moved(p.z, z)});
  return all;
}

/// How far outside the trixel's sides a point lies, in radians; at most 0 when it is inside.
double outside(const dvec3& u, const Corners& c) {
  double worst = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3 &a = c[k], &b = c[(k + 1) % 3];
    worst = std::max(worst, -glm::dot(glm::cross(a - u, b - u), u) / glm::distance(a, b));
  }
  return worst;
}

/// Counts violations of ownership for one point at every level.
int violations(const dvec3& u) {
  const Trixel owner = true_owner(u, kMaxLevel);
  int count = 0;
  for (int level = 0; level <= kMaxLevel; ++level)
    count += trixel_at(u, level).id != owner.id >> (2 * (kMaxLevel - level));
  // A side's vertices are rounded at every level above, hence a few roundings beside the point at most.
  count += outside(u, globe::htm::corners(owner)) > 1e-15;
  return count;
}

TEST(H5, EveryPointHasTheOneOwnerThatExactSignsName) {
  std::size_t wrong = 0;
  const auto special = with_surroundings(special_points());
  const std::size_t step = hard::full() ? 1 : 10;
  for (std::size_t k = 0; k < special.size(); k += step)
    wrong += static_cast<std::size_t>(violations(special[k]));
  std::mt19937_64 random(50);
  const std::size_t count = hard::cases(1'000'000);
  for (std::size_t k = 0; k < count; ++k)
    wrong += static_cast<std::size_t>(violations(hard::random_direction(random)));
  hard::report("H5",
               "points with a wrong owner at any level 0-28: " + std::to_string(special.size() / step) +
                   " special, " + std::to_string(count) + " random",
               "0", std::to_string(wrong));
  EXPECT_EQ(wrong, 0u);
}

TEST(H5, PointsOnDeepVerticesAndEdgesHaveTheOneOwnerThatExactSignsName) {
  std::mt19937_64 random(51);
  std::size_t wrong = 0;
  const std::size_t count = hard::cases(100'000);
  for (std::size_t k = 0; k < count; ++k) {
    const int level = static_cast<int>(random() % 28);
    const Corners c = globe::htm::corners({(8ULL << (2 * level)) + random() % (8ULL << (2 * level))});
    dvec3 p = k % 2 == 0 ? c[0] : globe::htm::midpoint(c[0], c[1]);
    const int axis = static_cast<int>(random() % 3);
    p[axis] = hard::moved(p[axis], static_cast<int>(random() % 9) - 4);
    wrong += static_cast<std::size_t>(violations(k % 3 == 0 ? c[1] : glm::normalize(p)));
  }
  hard::report("H5", "wrong owners on and 4 ulp around " + std::to_string(count) + " deep vertices", "0",
               std::to_string(wrong));
  EXPECT_EQ(wrong, 0u);
}

TEST(H5, OneByOneAndInVectorsAgree) {
  auto points = with_surroundings(special_points());
  std::mt19937_64 random(56);
  const std::size_t count = hard::cases(1'000'000);
  for (std::size_t k = 0; k < count; ++k) points.push_back(hard::random_direction(random));
  std::vector<Trixel> together(points.size());
  std::size_t different = 0;
  for (const int level : {0, 1, 5, 20, kMaxLevel}) {
    globe::htm::trixels_at(points, level, together);
    for (std::size_t k = 0; k < points.size(); ++k) different += together[k] != trixel_at(points[k], level);
  }
  hard::report("H5",
               "one by one and in vectors differ, " + std::to_string(points.size()) + " points, 5 levels",
               "0", std::to_string(different));
  EXPECT_EQ(different, 0u);
}

TEST(H5, IdGoesToCentreAndBack) {
  std::mt19937_64 random(52);
  std::size_t wrong = 0;
  const std::size_t count = hard::cases(1'000'000);
  for (std::size_t k = 0; k < count; ++k) {
    const int level = static_cast<int>(k % (kMaxLevel + 1));
    const Trixel t{(8ULL << (2 * level)) + random() % (8ULL << (2 * level))};
    wrong += trixel_at(globe::htm::center(t), level) != t;
  }
  hard::report("H5", "id -> centre -> id, levels 0-28, " + std::to_string(count), "0 wrong",
               std::to_string(wrong));
  EXPECT_EQ(wrong, 0u);
}

TEST(H5, LongitudesAWholeTurnApartAgree) {
  std::mt19937_64 random(53);
  std::uniform_real_distribution<double> latitude(-90, 90);
  std::size_t wrong = 0;
  const std::size_t count = hard::cases(1'000'000);
  for (std::size_t k = 0; k < count; ++k) {
    const double lat = k % 10 == 0 ? 90.0 - 180.0 * static_cast<double>(k / 10 % 2) : latitude(random);
    // A multiple of 2^-40 degrees, so that adding 360 is exact; every fourth one is a multiple of 90 degrees.
    const double lon = k % 4 == 0 ? 90.0 * static_cast<double>(random() % 4)
                                  : std::ldexp(static_cast<double>(random() % (360ULL << 40)), -40);
    const Trixel expected = trixel_at(normal_from_degrees(lat, lon), kMaxLevel);
    for (const double turn : {-360.0, 360.0, -720.0})
      wrong += trixel_at(normal_from_degrees(lat, lon + turn), kMaxLevel) != expected;
    if (std::abs(lat) == 90.0) wrong += expected != trixel_at({0, 0, lat / 90.0}, kMaxLevel);
  }
  wrong += trixel_at(normal_from_degrees(12, 180), 28) != trixel_at(normal_from_degrees(12, -180), 28);
  wrong += trixel_at(normal_from_degrees(12, 0.0), 28) != trixel_at(normal_from_degrees(-(-12.0), -0.0), 28);
  wrong += trixel_at(normal_from_degrees(0.0, 33), 28) != trixel_at(normal_from_degrees(-0.0, 33), 28);
  hard::report("H5",
               "lon and lon ± 360 in different trixels, poles with every longitude, " + std::to_string(count),
               "0", std::to_string(wrong));
  EXPECT_EQ(wrong, 0u);
}

/// Share of the side tests at one level in which a formula and the exact sign disagree.
template <typename Sign>
double wrong_share(int level, std::size_t count, Sign sign) {
  std::mt19937_64 random(54);
  std::size_t tests = 0, wrong = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3 u = hard::random_direction(random);
    const Corners c = globe::htm::corners(trixel_at(u, level - 1));
    for (int side = 0; side < 3; ++side, ++tests) {
      const Corners inner = child_corners(c, side);
      wrong += sign(inner[1], inner[2], u) != exact_orientation(inner[1], inner[2], u);
    }
  }
  return static_cast<double>(wrong) / static_cast<double>(tests);
}

int sign_of(double x) { return (x > 0) - (x < 0); }

TEST(H5, ThePlainTripleProductFailsAndTheDifferencesDoNot) {
  const std::size_t count = hard::cases(200'000);
  const auto plain = [](const dvec3& a, const dvec3& b, const dvec3& u) {
    return sign_of(glm::dot(glm::cross(a, b), u));
  };
  const auto differences = [](const dvec3& a, const dvec3& b, const dvec3& u) {
    return globe::htm::orientation(a, b, u).sign;
  };
  for (const int level : {25, 28}) {
    const double plain_wrong = wrong_share(level, count, plain);
    hard::report("H5", "negative control: wrong signs of dot(cross(a, b), p), level " + std::to_string(level),
                 "> 0", hard::figure(100 * plain_wrong) + " %");
    EXPECT_GT(plain_wrong, 0.0);
    EXPECT_EQ(wrong_share(level, count, differences), 0.0);
  }
}

/// Nanoseconds a point of a piece of work.
template <typename Work>
std::string cost(std::size_t count, Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
  return hard::figure(spent.count() / static_cast<double>(count)) + " ns";
}

TEST(H5, OrdinaryLookupsNeedNoExactArithmetic) {
  std::mt19937_64 random(55);
  const std::size_t count = hard::cases(4'000'000);
  std::vector<dvec3> points(count);
  for (dvec3& u : points) u = hard::random_direction(random);
  std::vector<Trixel> ids(count);
  for (const int level : {20, kMaxLevel}) {
    std::uint64_t exact_calls = 0;
    const std::string one_by_one = cost(count, [&] {
      for (std::size_t k = 0; k < count; ++k) ids[k] = trixel_at(points[k], level, &exact_calls);
    });
    const std::string together = cost(count, [&] { globe::htm::trixels_at(points, level, ids); });
    const double rate = static_cast<double>(exact_calls) / static_cast<double>(count);
    hard::report("H5",
                 "exact tests per lookup, level " + std::to_string(level) + ", " + std::to_string(count) +
                     " random points (" + one_by_one + " one by one, " + together + " in vectors)",
                 level == 20 ? "< 1e-6" : "-", hard::figure(rate));
    if (level == 20) {
      EXPECT_LT(rate, 1e-6);
    }
  }
}

}  // namespace
