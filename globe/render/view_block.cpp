#include "globe/render/view_block.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "globe/render/air.h"

namespace globe::render {
namespace {

constexpr float kSunlight = 5.0f;  ///< sunlight above the air, in units of the tone curve's white
constexpr float kExposure = 1.0f;

}  // namespace

bool has_air(const planet::PlanetInfo& info) {
  return info.body == "earth" || info.name.rfind("procedural", 0) == 0;
}

ViewBlock view_block(const Camera& camera, const planet::Surface& surface, const glm::dvec3& sun,
                     double near_m) {
  return view_block(camera, surface.ellipsoid(), has_air(surface.info()), sun, near_m);
}

ViewBlock view_block(const Camera& camera, const geo::Ellipsoid& ellipsoid, bool air, const glm::dvec3& sun,
                     double near_m) {
  // The air follows the ellipsoid: scaled until that is a sphere, it is as thick everywhere.
  const double radius = ellipsoid.mean_radius();
  const glm::dvec3 rounding(radius / ellipsoid.a, radius / ellipsoid.a, radius / ellipsoid.b());
  ViewBlock block{};
  block.clip_from_relative = glm::mat4(clip_from_relative(camera, near_m));
  block.eye_km = glm::vec4(glm::vec3(camera.position * rounding * 1e-3), static_cast<float>(radius * 1e-3));
  block.sun = glm::vec4(glm::vec3(sun), kSunlight);
  block.rounding = {static_cast<float>(rounding.x), static_cast<float>(rounding.z), air ? 1.0f : 0.0f,
                    kExposure};
  block.right = glm::vec4(glm::vec3(camera.right * camera.tan_x()), 0.0f);
  block.up = glm::vec4(glm::vec3(camera.up * camera.tan_y()), 0.0f);
  block.forward = glm::vec4(glm::vec3(camera.forward), 0.0f);
  const glm::dvec3 eye_km = camera.position * rounding * 1e-3;
  const double height_km = std::max(glm::length(eye_km) - radius * 1e-3, 0.0);
  block.sun_at_eye = glm::vec4(1.0f, 1.0f, 1.0f, 0.0f);
  if (air) {
    const double cos_sun = glm::dot(glm::normalize(eye_km), sun);
    block.sun_at_eye = glm::vec4(sun_transmittance(static_cast<float>(height_km), static_cast<float>(cos_sun),
                                                   static_cast<float>(radius * 1e-3)),
                                 0.0f);
  }
  return block;
}

}  // namespace globe::render
