#pragma once

#include <array>
#include <vector>

#include "globe/effects/atmosphere_model.h"

namespace globe::effects {

/// What shaders/lib/scattering.glsl looks up.
struct AirTables {
  glm::ivec2 transmittance_size;
  std::vector<glm::vec4> transmittance;  ///< rows of a height each
  glm::ivec2 moments_size;
  std::array<std::vector<glm::vec4>, 6> moments;
};

/// Computes the tables on all cores. Light is gathered order by order, as in Bruneton and Neyret 2008.
AirTables air_tables(const AirModel& model, const AirTableSizes& sizes = {});

/// Light of the air along a ray of round space for sunlight of 1, by the very code of
/// shaders/lib/scattering.glsl, compiled here.
struct ScatteredRay {
  glm::vec3 eye, direction;  ///< direction unit
  float from, to;            ///< km from the eye
  glm::vec3 sun;             ///< unit
};
glm::vec3 air_radiance(const AirModel& model, const AirTables& tables, const ScatteredRay& ray, int panels,
                       bool sparing = false);

/// Where a ray's texel lies in the sky's map, column and row each 0 to 1, by the cosines of its azimuth from
/// the sun and of its zenith angle, and back; shaders/effects/atmosphere_map.glsl, compiled here.
glm::vec2 air_map_place(const AirModel& model, const glm::vec2& cosines, float eye_radius_km);
glm::vec2 air_map_cosines(const AirModel& model, const glm::vec2& place, float eye_radius_km);

}  // namespace globe::effects
