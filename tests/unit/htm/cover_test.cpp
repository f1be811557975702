#include "globe/htm/cover.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "globe/base/error.h"
#include "globe/geo/area.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/complement.h"
#include "globe/htm/cone.h"
#include "globe/htm/great_circle.h"

namespace globe::htm {
namespace {

using geo::normal_from_degrees;

double area(const IdRange& range, int level) {
  double sum = 0;
  for_each_whole_trixel(level, range, [&](Trixel t) { sum += geo::surface_area({1.0, 0.0}, corners(t)); });
  return sum;
}

double area(const std::vector<IdRange>& ranges, int level) {
  double sum = 0;
  for (const IdRange& range : ranges) sum += area(range, level);
  return sum;
}

std::uint64_t count(const std::vector<IdRange>& ranges) {
  std::uint64_t sum = 0;
  for (const IdRange& range : ranges) sum += range.last - range.first + 1;
  return sum;
}

TEST(Cone, RefusesAnglesThatAreNone) {
  for (const double bad : {-1e-300, 180.0001, std::nan(""), HUGE_VAL})
    EXPECT_THROW(Cone({1, 0, 0}, bad), UsageError) << bad;
}

TEST(Cone, HoldsItsCentreAndItsBorder) {
  for (const double radius_deg : {0.0, 1e-9, 1.0, 60.0, 90.0, 120.0, 179.0, 180.0}) {
    const Cone cone(normal_from_degrees(0, 10), radius_deg);
    EXPECT_TRUE(cone.contains(normal_from_degrees(0, 10))) << radius_deg;
    EXPECT_TRUE(cone.contains(normal_from_degrees(0, 10 + radius_deg))) << radius_deg;
    EXPECT_TRUE(cone.contains(normal_from_degrees(0, 10 - radius_deg))) << radius_deg;
    if (radius_deg < 179.5) {
      EXPECT_FALSE(cone.contains(normal_from_degrees(0, 10 + radius_deg + 1e-12))) << radius_deg;
    }
  }
}

TEST(Cover, OfTheWholeSphereIsOneRange) {
  const Cone all({0, 0, 1}, 180.0);
  for (int level = 0; level <= kMaxLevel; ++level) {
    const std::vector<IdRange> whole{{kFirstRoot << (2 * level), (16ULL << (2 * level)) - 1, true}};
    for (const std::size_t budget : {0, 1, 7}) {
      EXPECT_EQ(cover(all, {level, false, budget}), whole);
      EXPECT_EQ(cover(all, {level, true, budget}), whole);
    }
  }
}

TEST(Cover, OfNothingIsEmpty) {
  const Complement none(std::make_shared<Cone>(dvec3{0, 0, 1}, 180.0));
  for (const std::size_t budget : {0, 1, 7}) {
    EXPECT_TRUE(cover(none, {9, false, budget}).empty());
    EXPECT_TRUE(cover(none, {9, true, budget}).empty());
  }
}

TEST(Cover, OfAPointIsItsTrixelAndThoseItTouches) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const dvec3 u = glm::normalize(dvec3{normal(random), normal(random), normal(random)});
    const auto ranges = cover(Cone(u, 0.0), {20, false, 0});
    ASSERT_EQ(count(ranges), 1u);
    EXPECT_EQ(ranges[0].first, trixel_at(u, 20).id);
    EXPECT_TRUE(cover(Cone(u, 0.0), {20, true, 0}).empty());
  }
  EXPECT_EQ(count(cover(Cone({0, 0, 1}, 0.0), {20, false, 0})), 4u);  // a corner of the octahedron
}

TEST(Cover, OfTheComplementIsTheRest) {
  const auto cone = std::make_shared<Cone>(normal_from_degrees(-20, 179), 7.0);
  const Complement rest(cone);
  const int level = 8;
  EXPECT_EQ(count(cover(*cone, {level, false, 0})) + count(cover(rest, {level, true, 0})),
            8ULL << (2 * level));
  EXPECT_EQ(count(cover(*cone, {level, true, 0})) + count(cover(rest, {level, false, 0})),
            8ULL << (2 * level));
}

TEST(Cover, ComesToTheRegionsAreaFromBothSides) {
  const Cone cone(normal_from_degrees(48, 16), 3.0);
  const double exact = 2.0 * M_PI * (1.0 - std::cos(3.0 * M_PI / 180.0));
  double outer = 0, inner = 0;
  for (const int level : {8, 10, 12, 14}) {
    outer = area(cover(cone, {level, false, 0}), level);
    inner = area(cover(cone, {level, true, 0}), level);
    EXPECT_LT(inner, exact);
    EXPECT_GT(outer, exact);
  }
  EXPECT_LT(outer - inner, 0.01 * exact);
}

TEST(Cover, VisitsTheRangesThatItReturns) {
  const Cone cone(normal_from_degrees(10, 20), 5.0);
  for (const bool inner : {false, true}) {
    std::vector<IdRange> visited;
    visit_cover(cone, {11, inner, 0}, [&](const IdRange& range) { visited.push_back(range); });
    EXPECT_EQ(visited, cover(cone, {11, inner, 0}));
  }
}

TEST(Cover, TellsWhatLiesInside) {
  const Cone cone(normal_from_degrees(10, 20), 5.0);
  CoverSettings settings{10, false, 0, true};
  const auto split = cover(cone, settings);
  std::vector<IdRange> inside;
  for (const IdRange& range : split)
    if (range.inside) inside.push_back(range);
  EXPECT_EQ(count(inside), count(cover(cone, {10, true, 0})));
  EXPECT_EQ(count(split), count(cover(cone, {10, false, 0})));
  EXPECT_GT(inside.size(), 0u);
}

/// The least area that so many ranges of a full outer cover can have, and the greatest of an inner one.
double best_area(const std::vector<IdRange>& full, int level, std::size_t budget, bool inner) {
  std::vector<double> parts;
  if (inner) {
    for (const IdRange& range : full) parts.push_back(area(range, level));
  } else {
    for (std::size_t k = 1; k < full.size(); ++k)
      parts.push_back(area({full[k - 1].last + 1, full[k].first - 1}, level));
  }
  std::sort(parts.begin(), parts.end(), std::greater<>());
  parts.resize(std::min(parts.size(), inner ? budget : budget - 1));
  const double sum = std::accumulate(parts.begin(), parts.end(), 0.0);
  return inner ? sum : area({full.front().first, full.back().last}, level) - sum;
}

TEST(Cover, WithABudgetIsAsTightAsTheIdsAllow) {
  constexpr double kTolerance = 2e-3;  // cover.h: ends are left when they would gain less than a thousandth
  const int level = 12;
  for (const auto& [lat, lon] : {std::pair{48.0, 16.0}, std::pair{0.0, 0.0}, std::pair{-89.0, 7.0},
                                 std::pair{13.0, 179.9}, std::pair{-33.0, -70.0}}) {
    for (const double radius_deg : {1.0, 8.0}) {
      const Cone cone(normal_from_degrees(lat, lon), radius_deg);
      for (const bool inner : {false, true}) {
        const auto full = cover(cone, {level, inner, 0});
        for (const std::size_t budget : {1, 2, 5, 20, 64, 200}) {
          const auto ranges = cover(cone, {level, inner, budget});
          const double best = best_area(full, level, budget, inner);
          EXPECT_LE(ranges.size(), budget);
          EXPECT_NEAR(area(ranges, level), best, kTolerance * best)
              << lat << " " << radius_deg << " " << budget;
        }
      }
    }
  }
}

TEST(Cover, ThatFitsTheBudgetComesOutWhole) {
  const Cone cone(normal_from_degrees(48, 16), 1.0);
  for (const bool inner : {false, true}) {
    const auto full = cover(cone, {10, inner, 0});
    EXPECT_EQ(cover(cone, {10, inner, full.size()}), full);
    EXPECT_EQ(cover(cone, {10, inner, 100'000}), full);
  }
}

TEST(Cover, HugeOnesStreamInConstantMemory) {
  // Millions of ranges: only counted.
  const Cone cone(normal_from_degrees(5, 5), 40.0);
  std::uint64_t ranges = 0;
  visit_cover(cone, {14, false, 0}, [&](const IdRange&) { ++ranges; });
  EXPECT_GT(ranges, 30'000u);
}

RC_GTEST_PROP(GreatCircle, SideIsTheExactSign, (std::uint32_t seed)) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return glm::normalize(dvec3{normal(random), normal(random), normal(random)});
  };
  const dvec3 a = direction();
  const double size = std::ldexp(1.0, -static_cast<int>(random() % 50));
  const dvec3 b = glm::normalize(a + size * direction());
  const GreatCircle circle(a, b);
  for (int k = 0; k < 100; ++k) {
    const dvec3 on = glm::normalize(glm::mix(a, b, 3.0 * normal(random)));
    const dvec3 p =
        k % 2 == 0 ? on
                   : glm::normalize(on + std::ldexp(size, -static_cast<int>(random() % 60)) * direction());
    RC_ASSERT(circle.side(p) == exact_orientation(a, b, p));
  }
}

}  // namespace
}  // namespace globe::htm
