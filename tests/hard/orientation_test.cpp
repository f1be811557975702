// H7: near-collinear triples have consistent signs, and seldom need exact arithmetic.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "globe/htm/midpoint.h"
#include "globe/htm/predicates.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace {

using globe::htm::exact_orientation;
using globe::htm::orientation;
using hard::dvec3;

struct Triple {
  dvec3 a, b, c;
};

/// Two points and a third on the arc between them, moved off it by `offset` of the arc's length.
Triple near_collinear(std::mt19937_64& random, double length, double offset) {
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  const dvec3 a = hard::random_direction(random);
  const dvec3 tangent = glm::normalize(glm::cross(a, hard::random_direction(random)));
  const dvec3 pole = glm::cross(a, tangent);
  const auto along = [&](double angle) { return std::cos(angle) * a + std::sin(angle) * tangent; };
  return {a, along(length), glm::normalize(along(unit(random) * length) + offset * length * pole)};
}

/// 0 when the six orders of the triple have the signs that rotation and exchange demand, and the exact one.
int inconsistencies(const Triple& t) {
  const int sign = exact_orientation(t.a, t.b, t.c);
  return (orientation(t.a, t.b, t.c).sign != sign) + (orientation(t.b, t.c, t.a).sign != sign) +
         (orientation(t.c, t.a, t.b).sign != sign) + (orientation(t.b, t.a, t.c).sign != -sign) +
         (orientation(t.a, t.c, t.b).sign != -sign) + (orientation(t.c, t.b, t.a).sign != -sign);
}

double log_uniform(std::mt19937_64& random, double low, double high) {
  std::uniform_real_distribution<double> exponent(std::log10(low), std::log10(high));
  return std::pow(10.0, exponent(random));
}

TEST(H7, NearCollinearTriplesHaveConsistentSigns) {
  std::mt19937_64 random(70);
  const std::size_t count = hard::cases(1'000'000);
  std::size_t inconsistent = 0, fallbacks = 0, plain_wrong = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double offset = log_uniform(random, 1e-12, 1e-6) * (k % 2 == 0 ? 1 : -1);
    const Triple t = near_collinear(random, log_uniform(random, 1e-6, 3.0), offset);
    inconsistent += static_cast<std::size_t>(inconsistencies(t));
    fallbacks += orientation(t.a, t.b, t.c).exact;
    const double plain = glm::dot(glm::cross(t.a, t.b), t.c);
    plain_wrong += (plain > 0) - (plain < 0) != exact_orientation(t.a, t.b, t.c);
  }
  const double rate = static_cast<double>(fallbacks) / static_cast<double>(count);
  hard::report("H7", "inconsistent signs of " + std::to_string(count) + " near-collinear triples", "0",
               std::to_string(inconsistent));
  hard::report("H7", "exact fallback, triples offset by 1e-12 to 1e-6 of their length", "< 1 %",
               hard::figure(100 * rate) + " %");
  hard::report("H7", "negative control: wrong signs of dot(cross(a, b), c)", "> 0",
               hard::figure(100 * static_cast<double>(plain_wrong) / static_cast<double>(count)) + " %");
  EXPECT_EQ(inconsistent, 0u);
  EXPECT_LT(rate, 0.01);
  EXPECT_GT(plain_wrong, 0u);
}

TEST(H7, TriplesWithinRoundingOfACircleHaveConsistentSigns) {
  std::mt19937_64 random(71);
  const std::size_t count = hard::cases(1'000'000);
  std::size_t inconsistent = 0, fallbacks = 0;
  for (std::size_t k = 0; k < count; ++k) {
    Triple t = near_collinear(random, log_uniform(random, 1e-9, 3.0), 0.0);
    if (k % 2 == 0) t.c = globe::htm::midpoint(t.a, t.b);
    if (k % 5 == 0) t.c = t.a;
    inconsistent += static_cast<std::size_t>(inconsistencies(t));
    fallbacks += orientation(t.a, t.b, t.c).exact;
  }
  hard::report("H7",
               "inconsistent signs of " + std::to_string(count) + " triples within rounding of a circle (" +
                   hard::figure(100 * static_cast<double>(fallbacks) / static_cast<double>(count)) +
                   " % exact)",
               "0", std::to_string(inconsistent));
  EXPECT_EQ(inconsistent, 0u);
}

TEST(H7, CollinearTriplesAreFoundSoAndAlwaysFallBack) {
  std::mt19937_64 random(72);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 10'000; ++k) {
    // Coordinates x = y exactly: one meridian.
    const auto point = [&] {
      const double x = unit(random);
      return dvec3{x, x, unit(random)};
    };
    const globe::htm::Orientation seen = orientation(point(), point(), point());
    ASSERT_EQ(seen.sign, 0);
    ASSERT_TRUE(seen.exact);
  }
}

}  // namespace
