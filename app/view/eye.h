#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/standing_camera.h"
#include "globe/geo/ellipsoid.h"
#include "globe/render/camera.h"

namespace app::view {

/// How a standing camera's surroundings fall on a window. Pixels count from its left and top; the middle of
/// the first one is 0.5, 0.5.
struct Eye {
  globe::geo::Ellipsoid ellipsoid;
  double fov_deg = 60.0;  ///< from top to bottom
  glm::dvec2 size{1280.0, 720.0};

  globe::render::Camera camera(const Standpoint& stand) const;
  /// Unit direction of what is seen at a pixel, ECEF.
  glm::dvec3 direction(const globe::render::Camera& camera, glm::dvec2 pixel) const;
  /// The same for a camera at the origin that looks along +z, x to the right and y up; not of unit length.
  glm::dvec3 direction_in_view(glm::dvec2 pixel) const;
  /// Where a place is seen; nothing behind the camera.
  std::optional<glm::dvec2> pixel_of(const globe::render::Camera& camera, const glm::dvec3& place) const;
};

/// Heading and pitch with which a camera at `stand` sees in a direction at a pixel, the horizon level. Of two
/// ways the one nearer to the pitch it has; where there is none (a pixel beside the zenith's or the nadir's)
/// the nearest.
/// @param direction  ECEF, any length
Look aimed(const Eye& eye, const Standpoint& stand, const glm::dvec3& direction, glm::dvec2 pixel);

}  // namespace app::view
