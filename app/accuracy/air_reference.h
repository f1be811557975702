#pragma once

#include <glm/vec3.hpp>

namespace app::accuracy {

/// The air of shaders/lib/atmosphere.glsl without its approximations: the same coefficients and the same
/// repeated scattering, columns and rays integrated numerically in double precision. Kilometres from the
/// planet's centre, sunlight of 1.

/// How columns toward the sun are had.
enum class Columns {
  kIntegrated,   ///< numerically
  kApproximate,  ///< by Schüler's formula, as in the shader: what is left then is the error of the steps
};

struct ReferenceRay {
  glm::dvec3 eye, direction;  ///< direction unit
  double from, to;
  glm::dvec3 sun;
  double ground;
};

/// Column of air above a point toward a zenith angle, km of sea-level air; below the horizon it goes on
/// through the ground, as though that were air.
double air_column(Columns columns, double height_km, double cos_zenith, double ground_km,
                  double scale_height_km);

/// Light of the sky along a ray, relative error of the integration under 1e-6.
struct SkyParts {
  glm::dvec3 light;  ///< of Rayleigh and repeated scattering
  glm::dvec3 mie;    ///< of Mie scattering, without its phase
  double phase;      ///< that Mie light is to be multiplied with

  glm::dvec3 sum() const { return light + mie * phase; }
  /// With Mie light in the colours of the rest, as the sky's map has it.
  glm::dvec3 tinted_sum() const;
};
SkyParts sky_parts(Columns columns, const ReferenceRay& ray);

}  // namespace app::accuracy
