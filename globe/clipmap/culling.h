#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "globe/geo/ellipsoid.h"

namespace globe::clipmap {

using glm::dvec3;

/// The five planes of a view with its far plane at infinity, through the camera, normals inward;
/// camera-relative metres.
struct Frustum {
  std::array<dvec3, 4> sides;
  dvec3 forward;

  /// @param forward, right, up  orthonormal
  /// @param tan_x, tan_y        half the width and height of the view at distance 1
  Frustum(const dvec3& forward, const dvec3& right, const dvec3& up, double tan_x, double tan_y);

  /// False only when the sphere is wholly outside.
  bool sees(const dvec3& centre, double radius) const;
};

/// What the planet's own body hides. The occluder is an ellipsoid of the planet's shape inside everything
/// drawn, so nothing visible is culled; in space scaled until it is the unit sphere the horizon is a circle.
class Horizon {
 public:
  /// @param lowest_m  a height above the ellipsoid that nothing drawn lies below, metres
  Horizon(const geo::Ellipsoid& ellipsoid, double lowest_m, const dvec3& camera_ecef);

  /// False only when what lies in a sphere (centre in ECEF metres) and no higher above the ellipsoid than
  /// `highest_m` is wholly behind the horizon.
  bool sees(const dvec3& centre, double radius, double highest_m) const;

 private:
  dvec3 scale_;      ///< from ECEF metres to the space in which the occluder is the unit sphere
  double widest_;    ///< the largest of scale_
  double shortest_;  ///< axes of the ellipsoid, metres
  double longest_;
  dvec3 to_camera_;  ///< unit, there
  double camera_distance_;
  double camera_angle_;  ///< from the camera's vertical to its horizon; negative: inside the occluder,
                         ///< everything is seen
};

}  // namespace globe::clipmap
