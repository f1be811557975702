#include "globe/geo/arctangent.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

namespace globe::geo {
namespace {

TEST(Arctangent, AgreesWithHigherPrecision) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> direction(-1.0, 1.0), magnitude(-300.0, 300.0);
  long double largest = 0;
  for (int k = 0; k < 1'000'000; ++k) {
    const double scale = k % 4 == 0 ? std::pow(10.0, magnitude(random)) : 1.0;
    const double squeeze = k % 3 == 0 ? std::pow(10.0, -8.0 * std::abs(direction(random))) : 1.0;
    const double x = direction(random) * scale, y = direction(random) * scale * squeeze;
    const long double truth = std::atan2(static_cast<long double>(y), static_cast<long double>(x)) * 180 /
                              std::numbers::pi_v<long double>;
    largest = std::max(largest, std::abs(static_cast<long double>(arctangent(y, x)) - truth));
  }
  EXPECT_LT(largest, 5e-14L);
  EXPECT_GT(largest, 1e-15L);
}

TEST(Arctangent, GivesMultiplesOf45DegreesExactly) {
  const std::array<std::array<double, 3>, 9> cases{{{0, 1, 0},
                                                    {1, 1, 45},
                                                    {1, 0, 90},
                                                    {1, -1, 135},
                                                    {0, -1, 180},
                                                    {-1, -1, -135},
                                                    {-1, 0, -90},
                                                    {-1, 1, -45},
                                                    {0, 0, 0}}};
  for (const auto& [y, x, angle] : cases) EXPECT_EQ(arctangent(y, x), angle) << y << " " << x;
  EXPECT_EQ(arctangent(-0.0, -1.0), -180.0);
}

GLOBE_FOR_EVERY_VECTOR_WIDTH
void arctangents(const double* y, const double* x, std::size_t count, double* out) {
  for (std::size_t k = 0; k < count; ++k) out[k] = arctangent(y[k], x[k]);
}

TEST(Arctangent, GivesVectorsTheBitsOfSingleValues) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> direction(-1.0, 1.0);
  std::vector<double> x(1003), y(1003), out(1003);
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] = direction(random);
    y[k] = direction(random);
  }
  arctangents(y.data(), x.data(), x.size(), out.data());
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_EQ(out[k], arctangent(y[k], x[k]));
}

}  // namespace
}  // namespace globe::geo
