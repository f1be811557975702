// Errors of drawing that `globe accuracy` reports, measured anew by other means: on the GPU.

#include <glm/geometric.hpp>
#include <random>

#include "app/accuracy/depth_scheme.h"
#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/position_error.h"
#include "app/accuracy/position_yardsticks.h"
#include "tests/render/ground/views.h"

namespace {

namespace accuracy = app::accuracy;
using accuracy::DepthScheme;
using accuracy::Yardstick;
using views::dvec3;

/// A context of their own would leave the tests' one without its thread: theirs is lent.
TEST_F(GlTest, PlanesAsFarApartAsReportedAndRoundedAgainAreToldApartAndAThirdOfItNotAlways) {
  for (const DepthScheme scheme : accuracy::kDepthSchemes) {
    const accuracy::DepthPlanes planes(lent(context()), scheme, 16, 16);
    for (const double distance : {1.0, 100.0, 1e4, 1e6}) {
      double widest = 0;
      for (const double at : accuracy::depth_sample(distance))
        widest = std::max(widest, accuracy::smallest_separation(scheme, at));
      if (distance + 3.0 * widest > accuracy::kFar) continue;
      int confused = 0;
      for (int k = 0; k < 200; ++k) {
        const double at = distance * (1.0 + 5e-4 * k);
        // llvmpipe rounds depth in between, too: of planes twice the step apart 5 in 1000 are confused.
        EXPECT_EQ(planes.shown({at, at + 3.0 * widest}), 0) << accuracy::name_of(scheme) << " at " << at;
        EXPECT_EQ(planes.shown({at + 3.0 * widest, at}), 1) << accuracy::name_of(scheme) << " at " << at;
        confused += planes.shown({at + widest / 3.0, at}) == 0 ? 1 : 0;
      }
      EXPECT_GT(confused, 0) << accuracy::name_of(scheme) << " at " << distance;
    }
  }
}

/// What a yardstick's arithmetic should give, on the CPU, with the camera and the place as floats.
glm::vec3 on_cpu(Yardstick yardstick, const dvec3& place, const dvec3& camera) {
  glm::vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = place[axis], c = camera[axis];
    if (yardstick == Yardstick::kFloat) {
      result[axis] = static_cast<float>(x) - static_cast<float>(c);
    } else if (yardstick == Yardstick::kHighLow) {
      const auto high = [](double value) { return std::trunc(value / 65536.0) * 65536.0; };
      const float highs = static_cast<float>(high(x)) - static_cast<float>(high(c));
      result[axis] = highs + (static_cast<float>(x - high(x)) - static_cast<float>(c - high(c)));
    } else {
      result[axis] = static_cast<float>(x - c);
    }
  }
  return result;
}

TEST_F(GlTest, YardsticksErrByWhatTheirArithmeticDoesOnTheCpu) {
  const auto surface = views::builtin_planet();
  const auto camera =
      accuracy::camera_over(*surface, globe::geo::normal_from_degrees(35.2644, -135.0), 2.0, 70.0, -6.0);
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<dvec3> corners;
  while (corners.size() < 3000) {
    const double away = 2.0 * std::pow(1e4, 0.5 + 0.5 * unit(random));
    const dvec3 relative =
        away * (camera.forward + 0.5 * unit(random) * camera.right + 0.3 * unit(random) * camera.up);
    corners.push_back(camera.position + relative);
  }
  const dvec3 anchor = camera.position - 2.0 * camera.up;
  for (const Yardstick yardstick : accuracy::kYardsticks) {
    const auto clip = accuracy::YardstickMesh(lent(context()), yardstick, corners, camera, anchor).clip();
    double seen = 0, expected = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const dvec3 relative = corners[k] - camera.position;
      const auto truth = accuracy::pixel(camera, relative);
      ASSERT_TRUE(truth);
      const auto by_cpu = accuracy::pixel(camera, dvec3(on_cpu(yardstick, corners[k], camera.position)));
      seen = std::max(seen, glm::length(accuracy::pixel_of_clip(clip[k]) - *truth));
      if (by_cpu) expected = std::max(expected, glm::length(*by_cpu - *truth));
    }
    if (yardstick == Yardstick::kFloat || yardstick == Yardstick::kHighLow) {
      EXPECT_NEAR(seen, expected, 0.05 * expected + 1e-3) << accuracy::name_of(yardstick);
    } else {
      EXPECT_LT(seen, 1e-3) << accuracy::name_of(yardstick);
    }
  }
}

TEST_F(GlTest, DetailErrsLessTheFinerItIsAndTheSameTwice) {
  using globe::clipmap::Settings;
  const std::vector<Settings> settings{Settings::for_detail(16), Settings::for_detail(64)};
  const accuracy::PictureSize picture{320, 180, 60.0};
  const auto once = accuracy::drawn_errors(settings, views::builtin_planet(), picture, 3);
  const auto again = accuracy::drawn_errors(settings, views::builtin_planet(), picture, 3);
  EXPECT_GT(once[0].rms, 1.5 * once[1].rms);
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].max, again[k].max);
    EXPECT_EQ(once[k].rms, again[k].rms);
    EXPECT_EQ(once[k].where, again[k].where);
  }
}

}  // namespace
