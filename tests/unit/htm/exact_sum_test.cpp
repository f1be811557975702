#include "globe/htm/exact_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace globe::htm {
namespace {

constexpr double kTiniest = std::numeric_limits<double>::denorm_min();

TEST(ExactSum, OfNothingIsZero) { EXPECT_EQ(ExactSum{}.sign(), 0); }

TEST(ExactSum, KeepsTheSmallestProductBesideTheLargest) {
  ExactSum sum;
  sum.add(0x1p99, 0x1p99, 0x1p99);
  sum.add(kTiniest, kTiniest, -kTiniest);
  EXPECT_EQ(sum.sign(), 1);
  sum.add(-0x1p99, 0x1p99, 0x1p99);
  EXPECT_EQ(sum.sign(), -1);
  sum.add(-kTiniest, -kTiniest, kTiniest);
  EXPECT_EQ(sum.sign(), 0);
}

TEST(ExactSum, AgreesWithIntegersOnRandomSumsAtEveryScale) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> small(-1000, 1000);
  std::uniform_int_distribution<int> exponent(-1000, 80);
  for (int trial = 0; trial < 20'000; ++trial) {
    const double x = std::ldexp(1.0, exponent(random));
    const double y = std::ldexp(1.0, exponent(random));
    const double z = std::ldexp(1.0, exponent(random));
    ExactSum sum;
    long long expected = 0;
    for (int k = 0; k < 4; ++k) {
      const int a = small(random), b = small(random), c = small(random);
      sum.add(a * x, b * y, c * z);
      expected += static_cast<long long>(a) * b * c;
    }
    ASSERT_EQ(sum.sign(), (expected > 0) - (expected < 0)) << trial;
    // Whatever is there, taking as many ones away (in steps below 1e9) brings it to nothing.
    const double steps = static_cast<double>(-expected);
    sum.add(steps * x, y, z);
    ASSERT_EQ(sum.sign(), 0) << trial;
  }
}

TEST(ExactSum, CancelsFullMantissas) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 20'000; ++trial) {
    const double a = unit(random), b = unit(random), c = std::ldexp(unit(random), trial % 1000 - 1000);
    ExactSum sum;
    sum.add(a, b, c);
    sum.add(c, -a, b);
    ASSERT_EQ(sum.sign(), 0);
    sum.add(kTiniest, trial % 2 == 0 ? 0x1p-90 : -0x1p-90, 1.0);
    ASSERT_EQ(sum.sign(), trial % 2 == 0 ? 1 : -1);
  }
}

}  // namespace
}  // namespace globe::htm
