#include "globe/render/air.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace globe::render {
namespace shader {

using namespace glm;

#define OUT(type) type&
#include "shaders/lib/atmosphere.glsl"
#include "shaders/lib/sky_map.glsl"
#undef OUT

}  // namespace shader

glm::vec3 sun_transmittance(float height_km, float cos_sun, float ground_radius_km) {
  return shader::sun_transmittance(height_km, cos_sun, ground_radius_km);
}

glm::vec4 sky_texel(const AirRay& ray, int steps) {
  return shader::sky_light(ray.eye, ray.direction, ray.from, ray.to, ray.sun, ray.ground, steps);
}

glm::vec3 with_mie(const glm::vec4& texel, float cos_angle) { return shader::with_mie(texel, cos_angle); }

glm::vec3 sky_light(const AirRay& ray, int steps) {
  return with_mie(sky_texel(ray, steps), glm::dot(ray.direction, ray.sun));
}

glm::vec2 sky_map_place(const glm::vec2& cosines, float eye_radius_km, float ground_radius_km) {
  return {shader::sky_column(cosines.x),
          shader::sky_row(cosines.y, shader::sky_bounds(eye_radius_km, ground_radius_km,
                                                        ground_radius_km + shader::kAirTop))};
}

glm::vec2 sky_map_cosines(const glm::vec2& place, float eye_radius_km, float ground_radius_km) {
  return {shader::cos_azimuth_of_column(place.x),
          shader::cos_zenith_of_row(place.y, shader::sky_bounds(eye_radius_km, ground_radius_km,
                                                                ground_radius_km + shader::kAirTop))};
}

glm::vec3 haze(const AirRay& ray, int steps) {
  const float cos_sun = glm::dot(glm::normalize(ray.eye + ray.direction * ray.to), ray.sun);
  glm::vec3 transmitted;
  return shader::light_before(ray.eye, ray.direction, ray.from, ray.to, ray.sun, cos_sun, ray.ground, steps,
                              transmitted);
}

float air_column(float height_km, float cos_zenith, float ground_radius_km, float scale_height_km) {
  return shader::air_column(height_km, cos_zenith, ground_radius_km, scale_height_km);
}

float air_top_km() { return shader::kAirTop; }

}  // namespace globe::render
