#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "globe/render/camera.h"

namespace globe::render {

/// How directions become places of a picture. The field of view is along the picture's height in each.
enum class Projection {
  kPerspective,      ///< a pinhole camera's; the field below 180 degrees
  kFisheye,          ///< equidistant: the distance from the middle is as the angle from the camera's axis; a
                     ///< disc as wide as the picture is high. Domes take 180 degrees.
  kEquirectangular,  ///< panoramas: columns are angles around the camera's up axis, rows are angles above its
                     ///< horizon; 2:1 and 180 degrees show everything
};

/// By the words of `--projection`; nothing for others.
std::optional<Projection> projection_by_name(std::string_view name);

/// The widest field of view of a projection, degrees, and what it has unless told otherwise.
double widest_fov_deg(Projection projection);
double usual_fov_deg(Projection projection);

/// Unit direction through a point of the picture: x from its left edge, y from its top, each 0 to 1. Nothing
/// outside a fisheye's disc and beyond a panorama's 360 degrees.
std::optional<dvec3> direction_through(Projection projection, const Camera& camera, double x, double y);

/// Where a direction of any length is seen, as x and y of direction_through; nothing behind a pinhole camera
/// and outside a fisheye's field. May lie outside the picture.
std::optional<glm::dvec2> seen_at(Projection projection, const Camera& camera, const dvec3& direction);

}  // namespace globe::render
