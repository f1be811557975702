#pragma once

#include <glm/vec4.hpp>

#include "globe/geo/ellipsoid.h"

namespace globe::effects {

/// What a shader needs of an eye to know latitude and longitude of places near it; mirrors `MapEye` in
/// shaders/lib/map_place.glsl (std140), which says what each member holds.
struct MapEye {
  glm::vec4 axes;
  glm::vec4 lengths;
};

/// @param eye  off the planet's centre
MapEye map_eye(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& eye);

}  // namespace globe::effects
