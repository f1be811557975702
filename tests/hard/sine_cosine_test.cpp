// The sines and cosines that trixel ids rest on, against quadruple precision (H22).

#include "globe/geo/sine_cosine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/hard/directions.h"
#include "tests/hard/quad.h"
#include "tests/hard/table.h"

namespace {

using globe::geo::SineCosine;
using hard::quad;

/// Of [-360, 360], and near the multiples of 45 degrees.
double random_angle(std::mt19937_64& random, std::size_t k) {
  if (k % 4 != 0) return std::uniform_real_distribution<double>(-360, 360)(random);
  const double base = 45.0 * (static_cast<double>(random() % 17) - 8.0);
  if (k % 8 == 0) return hard::moved(base, static_cast<int>(random() % 9) - 4);
  return base + std::ldexp(random() % 2 == 0 ? 1.0 : -1.0, -static_cast<int>(random() % 60));
}

double error_ulps(double seen, quad truth) {
  if (seen == 0.0 && truth == 0) return 0.0;
  const double size = std::abs(static_cast<double>(truth));
  const double ulp = std::nextafter(size, 2.0) - size;
  return std::abs(static_cast<double>((static_cast<quad>(seen) - truth) / ulp));
}

template <typename Function>
double worst_ulps(Function function) {
  std::mt19937_64 random(90);
  double worst = 0;
  for (std::size_t k = 0; k < hard::cases(2'000'000); ++k) {
    const double angle = random_angle(random, k);
    const SineCosine seen = function(angle);
    const auto [sine, cosine] = hard::quad_sine_cosine(angle);
    worst = std::max({worst, error_ulps(seen.sine, sine), error_ulps(seen.cosine, cosine)});
  }
  return worst;
}

TEST(H22, SinesAndCosinesOfDegreesAreGoodToTheLastPlace) {
  const double worst = worst_ulps(globe::geo::sine_cosine);
  hard::report("H22", "sine and cosine of degrees against __float128", "1.6 ulp", hard::figure(worst));
  EXPECT_LE(worst, 1.6);
}

TEST(H22, SinesAndCosinesOfRadiansAreNot) {
  const double worst = worst_ulps([](double angle) {
    return SineCosine{std::sin(angle * (M_PI / 180)), std::cos(angle * (M_PI / 180))};
  });
  hard::report("H22", "negative control: std::sin(degrees * pi / 180)", "> 1.6 ulp", hard::figure(worst));
  EXPECT_GT(worst, 1.6);
}

}  // namespace
