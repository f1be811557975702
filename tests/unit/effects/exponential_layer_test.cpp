// shaders/lib/exponential_layer.glsl, compiled as C++, against integrals along straight rays over a sphere.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "tests/hard/table.h"

namespace {
namespace shader {
using namespace glm;
#include "shaders/lib/exponential_layer.glsl"
}  // namespace shader
}  // namespace

namespace {

constexpr double kRadius = 6371000.0;

/// Column of a layer along a ray from a height, by Simpson's rule on exact heights over the sphere; metres.
double column(double low, double rise, double away, double scale) {
  const auto density = [&](double s) {
    const double r = kRadius + low;
    return std::exp(-(std::sqrt(r * r + 2.0 * r * s * rise + s * s) - kRadius) / scale);
  };
  // What lies beyond 40 scale heights adds nothing.
  const double climb = 40.0 * scale;
  const double enough = std::sqrt(rise * rise * kRadius * kRadius + 2.0 * kRadius * climb) - rise * kRadius;
  const double to = std::min(away, enough);
  constexpr int kSteps = 4000;
  double sum = density(0.0) + density(to);
  for (int k = 1; k < kSteps; ++k) sum += (k % 2 == 0 ? 2.0 : 4.0) * density(to * k / kSteps);
  return sum * to / kSteps / 3.0;
}

TEST(ExponentialLayer, ColumnsUpwardAgreeWithIntegralsOverTheSphere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0;
  for (int k = 0; k < 4000; ++k) {
    const double scale = std::pow(10.0, 1.0 + 3.0 * unit(random));
    const double low = scale * 6.0 * (unit(random) - 0.3);
    const double rise = k % 3 == 0 ? 0.0 : std::pow(10.0, -5.0 * unit(random));
    const double away = std::pow(10.0, 7.0 * unit(random));
    const double truth = column(low, rise, away, scale);
    const double seen = static_cast<double>(
        shader::layer_depth(static_cast<float>(low), static_cast<float>(rise), static_cast<float>(away),
                            static_cast<float>(scale), static_cast<float>(kRadius)));
    worst = std::max(worst, std::abs(seen / truth - 1.0));
  }
  hard::report("E5", "column of a fog layer, 4000 rays, worst", "0.5 %", hard::figure(100.0 * worst) + " %");
  EXPECT_LT(worst, 0.005);
}

TEST(ExponentialLayer, AVerticalColumnIsTheScaleHeight) {
  EXPECT_NEAR(shader::layer_depth(0.0f, 1.0f, 1e7f, 100.0f, 6.371e6f), 100.0f, 0.5f);
  EXPECT_NEAR(shader::layer_depth(100.0f, 1.0f, 1e7f, 100.0f, 6.371e6f), 36.8f, 0.3f);
}

TEST(ExponentialLayer, TheScaledErrorFunctionIsCloseToTheLibrarys) {
  double worst = 0;
  for (double x = 0.0; x < 5.0; x += 0.01) {
    const double truth = std::exp(x * x) * std::erfc(x);
    worst = std::max(worst,
                     std::abs(static_cast<double>(shader::scaled_erfc(static_cast<float>(x))) / truth - 1.0));
  }
  EXPECT_LT(worst, 0.0015);
}

}  // namespace
