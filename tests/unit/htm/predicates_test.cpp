#include "globe/htm/predicates.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "globe/htm/midpoint.h"
#include "tests/hard/directions.h"

namespace globe::htm {
namespace {

using hard::random_direction;

TEST(Orientation, OfTheAxesIsThatOfTheFrame) {
  const dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(orientation(x, y, z).sign, 1);
  EXPECT_EQ(orientation(y, x, z).sign, -1);
  EXPECT_EQ(orientation(x, y, x).sign, 0);
  EXPECT_EQ(orientation(x, y, midpoint(x, y)).sign, 0);
}

TEST(Orientation, RotatesAndFlips) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20'000; ++trial) {
    const dvec3 a = random_direction(random);
    const dvec3 b = trial % 2 == 0 ? random_direction(random) : a + 1e-9 * random_direction(random);
    const dvec3 c = trial % 3 == 0 ? midpoint(a, b) : random_direction(random);
    const int sign = orientation(a, b, c).sign;
    ASSERT_EQ(orientation(b, c, a).sign, sign);
    ASSERT_EQ(orientation(c, a, b).sign, sign);
    ASSERT_EQ(orientation(b, a, c).sign, -sign);
    ASSERT_EQ(exact_orientation(a, b, c), sign);
  }
}

TEST(Orientation, IsExactOnTheGreatCircleOfTwoPointsAndOneStepBesideIt) {
  // On the meridian x = y every point has equal first coordinates; one unit in the last place leaves it.
  const dvec3 a{0.5, 0.5, 0.70710678118654752};
  const dvec3 b{0.6, 0.6, 0.5291502622129181};
  for (const double t : {0.1, 0.55, 0.7}) {
    const dvec3 c{t, t, 0.3};
    const Orientation on = orientation(a, b, c);
    EXPECT_EQ(on.sign, 0);
    EXPECT_TRUE(on.exact);
    const int left = orientation(a, b, {t, std::nextafter(t, 1.0), 0.3}).sign;
    EXPECT_EQ(std::abs(left), 1);
    EXPECT_EQ(orientation(a, b, {t, std::nextafter(t, 0.0), 0.3}).sign, -left);
  }
}

TEST(Orientation, SeesCoordinatesFarBelowOneRounding) {
  const dvec3 x{1, 0, 0}, y{0, 1, 0};
  EXPECT_EQ(orientation(x, y, {0.6, 0.8, 1e-300}).sign, 1);
  EXPECT_EQ(orientation(x, y, {0.6, 0.8, -5e-324}).sign, -1);
  EXPECT_EQ(orientation(x, {0, 1, 5e-324}, {0.6, 0.8, 1e-323}).sign, 1);
}

}  // namespace
}  // namespace globe::htm
