// H5: the fast look-up answers what the exact walk answers, and its error bound holds.

#include "globe/htm/descent.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "globe/htm/midpoint.h"
#include "globe/htm/trixel.h"
#include "tests/hard/directions.h"
#include "tests/hard/quad.h"
#include "tests/hard/table.h"

namespace {

using globe::htm::Corners;
using globe::htm::Goal;
using globe::htm::goal_at;
using globe::htm::kLong;
using globe::htm::kMaxLevel;
using globe::htm::kShort;
using globe::htm::Trixel;
using globe::htm::trixel_at;
using globe::htm::trixel_by_walk;
using hard::dvec3;
using hard::quad;
using hard::QuadVector;

using Shares = std::array<double, 3>;

Shares sorted(Shares shares) {
  std::sort(shares.begin(), shares.end());
  return shares;
}

/// Barycentric coordinates of u in a trixel with ideal corners, ascending.
Shares true_shares(const dvec3& u, Trixel t) {
  const int level = globe::htm::level(t);
  std::array<QuadVector, 3> c;
  const Corners root = globe::htm::corners({t.id >> (2 * level)});
  for (std::size_t k = 0; k < 3; ++k) c[k] = {root[k].x, root[k].y, root[k].z};
  for (int below = level - 1; below >= 0; --below) {
    const QuadVector m0 = hard::normalized(c[1] + c[2]), m1 = hard::normalized(c[2] + c[0]),
                     m2 = hard::normalized(c[0] + c[1]);
    switch (t.id >> (2 * below) & 3) {
      case 0:
        c = {c[0], m2, m1};
        break;
      case 1:
        c = {c[1], m0, m2};
        break;
      case 2:
        c = {c[2], m1, m0};
        break;
      default:
        c = {m0, m1, m2};
    }
  }
  const QuadVector direction{u.x, u.y, u.z};
  const quad w0 = dot(direction, cross(c[1], c[2])), w1 = dot(direction, cross(c[2], c[0])),
             w2 = dot(direction, cross(c[0], c[1]));
  const quad sum = w0 + w1 + w2;
  return sorted(
      {static_cast<double>(w0 / sum), static_cast<double>(w1 / sum), static_cast<double>(w2 / sum)});
}

/// The same as a descent of kWalked levels has them.
template <int kWalked>
Shares descent_shares(const dvec3& u, const Goal& goal) {
  const auto d = globe::htm::descend<0, kWalked>(globe::htm::top_of(u.x, u.y, u.z).descent);
  const double scale = goal.cells / (d.w0 + d.w1 + d.w2);
  Shares shares{d.w0 * scale, d.w1 * scale, d.w2 * scale};
  for (double& share : shares) share -= std::floor(share);
  if (shares[0] + shares[1] + shares[2] > 1.5) {
    for (double& share : shares) share = 1.0 - share;
  }
  return sorted(shares);
}

/// Largest error of the shares of certain descents, in margins.
template <int kWalked>
double worst_error(const Goal& goal, std::size_t count) {
  std::mt19937_64 random(57);
  double worst = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3 u = hard::random_direction(random);
    const auto found = globe::htm::find<kWalked>(u.x, u.y, u.z, goal);
    if (found.certain == 0) continue;
    const Shares truth = true_shares(u, {found.id}), seen = descent_shares<kWalked>(u, goal);
    for (std::size_t corner = 0; corner < 3; ++corner)
      worst = std::max(worst, std::abs(seen[corner] - truth[corner]) / goal.margin);
  }
  return worst;
}

TEST(H5, WeightsAreWithinTheErrorBoundOfTheTruth) {
  const std::size_t count = hard::cases(200'000);
  const auto check = [&](int level, int walked, double worst) {
    hard::report("H5",
                 "error of the weights after " + std::to_string(walked) +
                     " levels against __float128, level " + std::to_string(level),
                 "1 margin", hard::figure(worst));
    EXPECT_LE(worst, 1.0);
  };
  check(11, kShort, worst_error<kShort>(goal_at<kShort>(11), count / 4));
  check(20, kShort, worst_error<kShort>(goal_at<kShort>(20), count / 4));
  check(28, kLong, worst_error<kLong>(goal_at<kLong>(28), count / 2));
}

TEST(H5, WeightsOfAShorterDescentAreBeyondTheBoundOfALongerOne) {
  Goal goal = goal_at<kShort>(22);
  goal.margin = goal_at<kLong>(22).margin;
  const double worst = worst_error<kShort>(goal, hard::cases(20'000));
  hard::report("H5", "negative control: 11 levels against the bound of 14", "> 1 margin",
               hard::figure(worst));
  EXPECT_GT(worst, 1.0);
}

TEST(H5, SidesAndHeightsOfTrixelsAreWhatTheErrorBoundTakesThemFor) {
  double longest = 0, lowest = 10, longest_before = 0, lowest_before = 10;
  std::vector<Corners> trixels{globe::htm::corners({15})};  // the eight roots are mirror images
  for (int level = 1; level <= 9; ++level) {
    std::vector<Corners> children;
    children.reserve(4 * trixels.size());
    longest_before = std::exchange(longest, 0);
    lowest_before = std::exchange(lowest, 10);
    for (const Corners& parent : trixels) {
      for (int k = 0; k < 4; ++k) {
        const Corners& c = children.emplace_back(globe::htm::child_corners(parent, k));
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const dvec3 &a = c[corner], &b = c[(corner + 1) % 3], &far = c[(corner + 2) % 3];
          const dvec3 normal = glm::normalize(glm::cross(a - b, a + b));
          longest = std::max(longest, std::ldexp(2 * std::asin(glm::distance(a, b) / 2), level));
          lowest = std::min(lowest, std::ldexp(std::abs(std::asin(glm::dot(normal, far))), level));
        }
      }
    }
    trixels = std::move(children);
    EXPECT_LE(longest, 2.46) << level;
    EXPECT_GE(lowest, 1.1) << level;
  }
  // They have converged: each level changes them by a quarter of what the last one did.
  EXPECT_LT(std::abs(longest - longest_before), 1e-4);
  EXPECT_LT(std::abs(lowest - lowest_before), 1e-4);
  hard::report("H5", "longest side and lowest height of a trixel, radians * 2^level", "<= 2.46, >= 1.1",
               hard::figure(longest) + ", " + hard::figure(lowest));
}

/// A point beside a side of a trixel of that level, at a distance between 1e-17 and 1 times its length.
dvec3 beside_a_side(std::mt19937_64& random, int level) {
  const Corners c = globe::htm::corners({(8ULL << (2 * level)) + random() % (8ULL << (2 * level))});
  std::uniform_real_distribution<double> unit(0, 1);
  const double along = random() % 4 == 0 ? static_cast<double>(random() % 5) / 4.0 : unit(random);
  const double across = std::pow(10.0, -17.0 * unit(random)) * (random() % 2 == 0 ? 1.0 : -1.0);
  return glm::normalize(c[0] + along * (c[1] - c[0]) + across * (c[2] - c[0]));
}

TEST(H5, BesideSidesOfAllLevelsTheFastLookUpAnswersWhatTheWalkDoes) {
  std::mt19937_64 random(58);
  const std::size_t count = hard::cases(2'000'000) / (kMaxLevel + 1);
  std::size_t wrong = 0, wrong_together = 0, walked = 0;
  for (int level = 0; level <= kMaxLevel; ++level) {
    std::vector<dvec3> points(count);
    for (dvec3& u : points) {
      // Of this level and of those near it, above and below.
      const int nearby = std::clamp(level + static_cast<int>(random() % 5) - 2, 0, kMaxLevel);
      u = beside_a_side(random, nearby);
    }
    std::vector<Trixel> together(count);
    walked += globe::htm::trixels_at(points, level, together);
    for (std::size_t k = 0; k < count; ++k) {
      const Trixel owner = trixel_by_walk(points[k], level);
      wrong += trixel_at(points[k], level) != owner;
      wrong_together += together[k] != owner;
    }
  }
  hard::report("H5",
               "fast look-ups, one by one and in vectors, that differ from the exact walk: " +
                   std::to_string(count * (kMaxLevel + 1)) + " points beside sides of all levels (" +
                   std::to_string(100 * walked / (count * (kMaxLevel + 1))) + " % were passed to the walk)",
               "0", std::to_string(wrong + wrong_together));
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(wrong_together, 0u);
}

TEST(H5, WithoutAMarginTheFastLookUpIsWrongBesideSides) {
  std::mt19937_64 random(59);
  Goal goal = goal_at<kShort>(20);
  goal.margin = 0;
  std::size_t wrong = 0;
  for (int k = 0; k < 20'000; ++k) {
    const dvec3 u = beside_a_side(random, 20);
    const auto found = globe::htm::find<kShort>(u.x, u.y, u.z, goal);
    wrong += found.certain != 0 && Trixel{found.id} != trixel_by_walk(u, 20);
  }
  hard::report("H5", "negative control: wrong owners beside sides with a margin of 0", "> 0",
               std::to_string(wrong));
  EXPECT_GT(wrong, 0u);
}

TEST(H5, RandomDirectionsGetTheSameTrixelsFromTheWalkAndFromAnyNumberOfThreads) {
  std::mt19937_64 random(60);
  std::vector<dvec3> points(hard::cases(4'000'000));
  for (dvec3& u : points) u = hard::random_direction(random);
  std::size_t wrong = 0;
  for (const int level : {8, 11, 12, 20, 22, 23, kMaxLevel}) {
    std::vector<Trixel> alone(points.size()), together(points.size());
    std::size_t walked_alone = 0;
    {
      const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
      walked_alone = globe::htm::trixels_at(points, level, alone);
    }
    const std::size_t walked = globe::htm::trixels_at(points, level, together);
    EXPECT_EQ(walked, walked_alone);
    EXPECT_EQ(alone, together);
    if (level == 20 || hard::full()) {
      for (std::size_t k = 0; k < points.size(); ++k)
        wrong += together[k] != trixel_by_walk(points[k], level);
    }
    if (level == 20 || level == kMaxLevel) {
      hard::report(
          "H5", "random directions passed to the walk at level " + std::to_string(level), "< 0.1 %",
          hard::figure(100.0 * static_cast<double>(walked) / static_cast<double>(points.size())) + " %");
      EXPECT_LT(walked, points.size() / 1000);
    }
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(H5, DirectionsOfAnyLengthAreFoundOrPassedOn) {
  std::mt19937_64 random(61);
  for (int k = 0; k < 2000; ++k) {
    const dvec3 u = hard::random_direction(random);
    for (const int power : {-1060, -1000, -600, -499, -30, 3, 300, 499, 501, 1000, 1023})
      for (const int level : {20, kMaxLevel}) {
        const dvec3 scaled{std::ldexp(u.x, power), std::ldexp(u.y, power), std::ldexp(u.z, power)};
        const auto found = level == 20
                               ? globe::htm::find<kShort>(scaled.x, scaled.y, scaled.z, goal_at<kShort>(20))
                               : globe::htm::find<kLong>(scaled.x, scaled.y, scaled.z, goal_at<kLong>(28));
        if (found.certain != 0) {
          ASSERT_EQ(Trixel{found.id}, trixel_by_walk(u, level)) << power;
        }
        if (power > -499 && power < 499) {
          ASSERT_EQ(trixel_at(scaled, 8), trixel_at(u, 8)) << power;
        }
      }
  }
}

}  // namespace
