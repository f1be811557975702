#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "globe/effects/atmosphere_model.h"

namespace app::accuracy {

/// Light of the air along a ray without tables, in double precision and in a way of its own: light scattered
/// once by quadrature, light scattered more often by Monte Carlo.
struct ScatteringRay {
  glm::dvec3 eye, direction;  ///< km from the planet's centre; unit
  double from, to;            ///< distances from the eye inside the air
  glm::dvec3 sun;             ///< unit
};

/// For sunlight of 1.
struct ScatteredLight {
  glm::dvec3 once;      ///< relative error under 1e-3
  glm::dvec3 again;     ///< by the air or the ground and then by the air, any number of times
  glm::dvec3 interval;  ///< of `again`: half the width of its 95 % confidence interval

  glm::dvec3 sum() const { return once + again; }
};

/// The stretch of a ray inside the air and before the ground; to = from where it misses the air.
ScatteringRay scattering_ray(const globe::effects::AirModel& model, const glm::dvec3& eye,
                             const glm::dvec3& direction, const glm::dvec3& sun);

/// Paths are added until the interval is as narrow as asked for, as a share of the sum in every channel, or
/// there are `most` of them.
ScatteredLight scattered_light(const globe::effects::AirModel& model, const ScatteringRay& ray,
                               double interval, std::int64_t most, std::uint64_t seed);

}  // namespace app::accuracy
