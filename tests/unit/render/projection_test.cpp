#include "globe/render/projection.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

namespace {
namespace shader {
using namespace glm;
#include "shaders/lib/projection.glsl"
}  // namespace shader
}  // namespace

namespace globe::render {
namespace {

constexpr double kPi = std::numbers::pi;

Camera camera_with(double fov_deg, double aspect) {
  return make_camera(geo::kWgs84, {46.0, 7.0, 3000.0}, 30.0, -20.0, fov_deg, aspect);
}

double angle_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(Projection, AFisheyesRadiusIsTheAngleFromItsAxis) {
  const Camera camera = camera_with(180.0, 1.0);
  EXPECT_EQ(*direction_through(Projection::kFisheye, camera, 0.5, 0.5), camera.forward);
  for (const double radius : {0.1, 0.5, 0.999}) {
    for (double turn = 0; turn < 6.28; turn += 0.3) {
      const auto ray = direction_through(Projection::kFisheye, camera, 0.5 + 0.5 * radius * std::cos(turn),
                                         0.5 - 0.5 * radius * std::sin(turn));
      ASSERT_TRUE(ray.has_value());
      EXPECT_NEAR(angle_between(*ray, camera.forward), radius * kPi / 2, 1e-12);
      EXPECT_NEAR(std::atan2(glm::dot(*ray, camera.up), glm::dot(*ray, camera.right)),
                  std::remainder(turn, 2 * kPi), 1e-12);
    }
  }
  EXPECT_FALSE(direction_through(Projection::kFisheye, camera, 0.01, 0.01).has_value());
}

TEST(Projection, APanoramasColumnsAndRowsAreAngles) {
  const Camera camera = camera_with(180.0, 2.0);
  for (const double x : {0.0, 0.25, 0.6, 1.0}) {
    for (const double y : {0.1, 0.5, 0.8}) {
      const dvec3 ray = direction_through(Projection::kEquirectangular, camera, x, y).value();
      EXPECT_NEAR(std::asin(glm::dot(ray, camera.up)), (0.5 - y) * kPi, 1e-12);
      EXPECT_NEAR(std::remainder(std::atan2(glm::dot(ray, camera.right), glm::dot(ray, camera.forward)) -
                                     (x - 0.5) * 2.0 * kPi,
                                 2.0 * kPi),
                  0.0, 1e-12);
    }
  }
  EXPECT_FALSE(
      direction_through(Projection::kEquirectangular, camera_with(180.0, 3.0), 0.01, 0.5).has_value());
}

TEST(Projection, ADomeHasTheZenithInItsMiddleAndTheHeadingAtItsLowerRim) {
  const geo::Geodetic place{46.0, 7.0, 3000.0};
  const Camera dome = make_camera(geo::kWgs84, place, 110.0, 90.0, 180.0, 1.0);
  const geo::LocalFrame frame = geo::local_frame(place.lat_deg, place.lon_deg);
  const auto seen = [&](double heading, double pitch) {
    return *seen_at(Projection::kFisheye, dome, geo::look_direction(frame, heading, pitch));
  };
  EXPECT_LT(glm::distance(seen(0.0, 90.0), glm::dvec2(0.5, 0.5)), 1e-12);
  EXPECT_LT(glm::distance(seen(110.0, 1e-9), glm::dvec2(0.5, 1.0)), 1e-9);
  EXPECT_LT(glm::distance(seen(200.0, 1e-9), glm::dvec2(1.0, 0.5)), 1e-9);  // to the right of it
}

RC_GTEST_PROP(Projection, WhereADirectionIsSeenItIs, ()) {
  const auto projection =
      *rc::gen::element(Projection::kPerspective, Projection::kFisheye, Projection::kEquirectangular);
  const Camera camera = camera_with(*rc::gen::inRange(1, 171), *rc::gen::inRange(5, 21) / 10.0);
  const double x = *rc::gen::inRange(1, 1000) / 1000.0, y = *rc::gen::inRange(1, 1000) / 1000.0;
  const auto ray = direction_through(projection, camera, x, y);
  if (!ray) return;
  RC_ASSERT(std::abs(glm::length(*ray) - 1.0) < 1e-12);
  const auto at = seen_at(projection, camera, *ray * 17.0);
  RC_ASSERT(at.has_value());
  RC_ASSERT(glm::distance(*at, glm::dvec2(x, y)) < 1e-9);
}

TEST(Projection, TheShadersDirectionsAreTheSameToAHundredthOfAPixel) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr double kPixel = kPi / 8192.0;
  for (const double fov : {60.0, 180.0, 360.0}) {
    Camera camera;
    camera.forward = dvec3(0, 0, 1);
    camera.right = dvec3(1, 0, 0);
    camera.up = dvec3(0, 1, 0);
    camera.fov_y_deg = fov;
    camera.aspect = 1.0;
    for (int k = 0; k < 10'000; ++k) {
      const double x = unit(random), y = unit(random);
      const glm::vec2 at(2.0 * x - 1.0, 1.0 - 2.0 * y);
      const auto half = static_cast<float>(fov * kPi / 360.0);
      if (const auto ray = direction_through(Projection::kFisheye, camera, x, y)) {
        ASSERT_LT(angle_between(*ray, shader::fisheye_direction(at, half)), 0.01 * kPixel);
      }
      if (fov > 180.0) continue;
      const auto ray = direction_through(Projection::kEquirectangular, camera, x, y);
      ASSERT_LT(angle_between(*ray, shader::equirectangular_direction(at, half)), 0.01 * kPixel);
    }
  }
}

TEST(Projection, ACubesFaceIsThatOfTheLargestAxis) {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  for (int k = 0; k < 10'000; ++k) {
    const glm::vec3 v(normal(random), normal(random), normal(random));
    const int face = shader::cube_face(v);
    const float along = v[face / 2] * (face % 2 == 0 ? 1.0f : -1.0f);
    ASSERT_GE(along, std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
  }
}

}  // namespace
}  // namespace globe::render
