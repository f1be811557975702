#include "globe/render/forecast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace globe::render {
namespace {

using glm::dvec3;

Forecast::Place on_circle(const dvec3& from, const dvec3& toward, double angle, double height_m) {
  return {glm::normalize(from * std::cos(angle) + toward * std::sin(angle)), height_m};
}

TEST(Forecast, GoesOnAlongTheGreatCircleAndInHeight) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 200; ++run) {
    const dvec3 from = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
    const dvec3 aside(normal(random), normal(random), normal(random));
    const dvec3 toward = glm::normalize(aside - from * glm::dot(aside, from));
    const double step = std::pow(10.0, -1.5 - 6.0 * (run % 10) / 10.0);
    const double growth = 1.0 - 0.1 * (run % 7) / 7.0;
    Forecast forecast;
    for (int frame = 0; frame < 4; ++frame)
      forecast.note(on_circle(from, toward, step * frame, 1e5 * std::pow(growth, frame)));
    EXPECT_TRUE(forecast.is_moving());
    for (const int frames : {0, 1, 7}) {
      const Forecast::Place ahead = forecast.ahead(frames);
      const Forecast::Place truth =
          on_circle(from, toward, step * (3 + frames), 1e5 * std::pow(growth, 3 + frames));
      EXPECT_LT(glm::distance(ahead.u, truth.u), 1e-9 + 1e-6 * step);
      EXPECT_NEAR(ahead.height_m / truth.height_m, 1.0, 1e-9);
    }
  }
}

TEST(Forecast, NothingIsForeseenOfACameraThatStandsOrJumps) {
  Forecast forecast;
  const dvec3 here(1, 0, 0), there(0, 0.6, 0.8);
  for (int frame = 0; frame < 3; ++frame) forecast.note({here, 100.0});
  EXPECT_FALSE(forecast.is_moving());
  forecast.note({there, 5.0});
  EXPECT_FALSE(forecast.is_moving());
  EXPECT_EQ(forecast.ahead(10).u, there);
  EXPECT_EQ(forecast.ahead(10).height_m, 5.0);
  forecast.note({here, 700.0});
  EXPECT_FALSE(forecast.is_moving());
}

TEST(Forecast, GroundThatRisesAndFallsIsNotADescent) {
  Forecast forecast;
  for (int frame = 0; frame < 10; ++frame)
    forecast.note(on_circle({1, 0, 0}, {0, 1, 0}, 1e-5 * frame, 100.0 + 20.0 * (frame % 3)));
  EXPECT_TRUE(forecast.is_moving());
  EXPECT_EQ(forecast.ahead(8).height_m, 100.0);
  EXPECT_LT(glm::distance(forecast.ahead(8).u, on_circle({1, 0, 0}, {0, 1, 0}, 1.7e-4, 1.0).u), 1e-9);
}

TEST(Forecast, NeverBeyondTheHorizonOfReason) {
  Forecast forecast;
  for (int frame = 0; frame < 4; ++frame) forecast.note(on_circle({1, 0, 0}, {0, 0, 1}, 0.4 * frame, 1e3));
  EXPECT_LE(glm::distance(forecast.ahead(100).u, forecast.ahead(0).u), 0.51);
}

}  // namespace
}  // namespace globe::render
