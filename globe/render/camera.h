#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "globe/geo/ellipsoid.h"

namespace globe::render {

using glm::dmat4;
using glm::dvec3;

/// A pinhole camera in ECEF. forward, right and up are orthonormal.
struct Camera {
  dvec3 position{0.0};
  dvec3 forward{1, 0, 0};
  dvec3 right{0, 1, 0};
  dvec3 up{0, 0, 1};
  double fov_y_deg = 60.0;  ///< vertical field of view
  double aspect = 16.0 / 9.0;

  double tan_y() const;
  double tan_x() const { return tan_y() * aspect; }
};

/// A camera at a geodetic place, looking along heading (degrees clockwise from north) and pitch (-90 down, 0
/// level). Looking straight down, the heading is what points up in the picture; at a pole the longitude says
/// which way north is.
Camera make_camera(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& place, double heading_deg,
                   double pitch_deg, double fov_y_deg, double aspect);

/// The camera turned about the way it looks, clockwise seen from behind it: its right side goes down.
Camera rolled(const Camera& camera, double roll_deg);

/// Unit direction through a point of the picture: x from its left edge, y from its top, each 0 to 1.
dvec3 direction_through(const Camera& camera, double x, double y);

/// Clip space of camera-relative positions: reversed depth with the far plane at infinity, near / distance in
/// [0, 1] (glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE)). No translation: positions come relative to the
/// camera. @approximation depth
dmat4 clip_from_relative(const Camera& camera, double near_m);

/// Near plane for a camera at a height above ground: min(0.05 m, height / 4), scaled by the planet's radius.
double near_distance(const geo::Ellipsoid& ellipsoid, double height_above_ground_m);

}  // namespace globe::render
