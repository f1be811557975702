#include "globe/render/air.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace {

namespace render = globe::render;
using glm::vec3;

constexpr float kGround = 6371.0f;
constexpr float kDegree = 0.0174532925f;

/// From a height down to the ground so far away from below it, toward the sun's side or away from it; the sun
/// stands over the eye's horizon.
render::AirRay toward_ground(float eye_km, float away_km, float sun_deg, float side) {
  const vec3 eye(0.0f, 0.0f, kGround + eye_km);
  const float turn = away_km / kGround;
  const vec3 ground = kGround * vec3(side * std::sin(turn), 0.0f, std::cos(turn));
  const vec3 direction = glm::normalize(ground - eye);
  const float along = glm::dot(eye, direction), top = kGround + render::air_top_km();
  const float inside = along * along - glm::dot(eye, eye) + top * top;
  const float from = eye_km > render::air_top_km() ? -along - std::sqrt(inside) : 0.0f;
  return {eye,
          direction,
          from,
          glm::length(ground - eye),
          {std::cos(sun_deg * kDegree), 0.0f, std::sin(sun_deg * kDegree)},
          kGround};
}

float brightest(const vec3& light) { return std::max({light.x, light.y, light.z}); }

TEST(Air, ThereIsNoHazeBeforeGroundInThePlanetsShadowHoweverHighTheEye) {
  for (const float eye_km : {1.0f, 100.0f, 290.0f, 310.0f, 2000.0f, 20000.0f}) {
    for (const float sun_deg : {-20.0f, -40.0f, -80.0f})
      EXPECT_LT(brightest(render::haze(toward_ground(eye_km, 200.0f, sun_deg, -1.0f), 4)), 1e-6f)
          << eye_km << " km, sun " << sun_deg;
  }
  // The eye in the sun over ground beyond the terminator.
  EXPECT_LT(brightest(render::haze(toward_ground(2000.0f, 3000.0f, 8.0f, -1.0f), 4)), 1e-5f);
}

TEST(Air, HazeFollowsTheAirsLightFromTheGroundToSpaceByDayAndAtTheTerminator) {
  for (const float eye_km : {0.002f, 12.0f, 100.0f, 400.0f, 2000.0f}) {
    for (const float sun_deg : {60.0f, 20.0f, 5.0f, 0.5f, -2.0f}) {
      for (const float away_km : {20.0f, 100.0f, 300.0f, 1000.0f, 3000.0f}) {
        for (const float side : {-1.0f, 1.0f}) {
          if (std::cos(away_km / kGround) * (kGround + eye_km) <= kGround) continue;  // beyond the horizon
          const render::AirRay ray = toward_ground(eye_km, away_km, sun_deg, side);
          const vec3 truth = render::sky_light(ray, 256);
          const float error = brightest(glm::abs(render::haze(ray, 4) - truth));
          EXPECT_LT(error, 0.2f * std::max(brightest(truth), 2e-3f))
              << eye_km << " km, sun " << sun_deg << ", " << side * away_km << " km away";
        }
      }
    }
  }
}

}  // namespace
