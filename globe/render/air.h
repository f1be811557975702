#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace globe::render {

/// How finely the light of the air is summed up, each a knob of accuracy (`globe accuracy --only sky`).
/// @approximation sky.steps, sky.map, sky.haze
struct AirSteps {
  int haze = 4;            ///< samples between the eye and a vertex, twice as many in twilight
  int sky = 16;            ///< samples along a ray of the sky's map
  glm::ivec2 map{96, 64};  ///< its texels across azimuth and up from the horizon
};

/// Share of sunlight that reaches a height (km) when the sun stands at a zenith angle; the very code of
/// shaders/lib/atmosphere.glsl, compiled here.
glm::vec3 sun_transmittance(float height_km, float cos_sun, float ground_radius_km);

/// A stretch of a ray through the air, in round space (shaders/lib/view.glsl), kilometres from the planet's
/// centre.
struct AirRay {
  glm::vec3 eye;
  glm::vec3 direction;  ///< unit
  float from, to;       ///< distances from the eye
  glm::vec3 sun;        ///< unit, toward it
  float ground;         ///< the planet's radius
};

/// Light of the sky along a ray for sunlight of 1; that code, too, compiled here. @approximation sky.model
glm::vec3 sky_light(const AirRay& ray, int steps);
/// As a texel of the sky's map has it: with_mie() makes light of it.
glm::vec4 sky_texel(const AirRay& ray, int steps);
glm::vec3 with_mie(const glm::vec4& texel, float cos_angle);

/// Where a ray's texel lies in the sky's map, column and row each 0 to 1, by the cosines of its azimuth from
/// the sun and of its zenith angle, and back; shaders/lib/sky_map.glsl, compiled here.
glm::vec2 sky_map_place(const glm::vec2& cosines, float eye_radius_km, float ground_radius_km);
glm::vec2 sky_map_cosines(const glm::vec2& place, float eye_radius_km, float ground_radius_km);

/// Light of the air before the ground at the end of a ray, as vertices have it: where the sun is low at one
/// end of the stretch, with twice as many samples, each with a sun of its own.
glm::vec3 haze(const AirRay& ray, int steps);

/// Column of air with a scale height above a point toward a zenith angle, km of sea-level air.
/// @approximation sky.columns
float air_column(float height_km, float cos_zenith, float ground_radius_km, float scale_height_km);

/// Height above which there is no air, km.
float air_top_km();

}  // namespace globe::render
