#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "app/point.h"
#include "globe/geo/ellipsoid.h"

namespace app {

/// Where the camera of a single picture stands: ALT counts from the ellipsoid, with --agl from the ground. A
/// camera lower than least_clearance is raised to that, with a warning when it was not asked for.
///
/// @param height_above_ground  of a position in ECEF, metres
globe::geo::Geodetic standing_place(const Point& at, bool agl, const globe::geo::Ellipsoid& ellipsoid,
                                    const std::function<double(const glm::dvec3&)>& height_above_ground);

}  // namespace app
