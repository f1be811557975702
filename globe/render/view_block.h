#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "globe/planet/surface.h"
#include "globe/render/camera.h"

namespace globe::render {

/// What every pass of a frame knows of the view; mirrors `View` in shaders/lib/view.glsl (std140), which says
/// what each member holds.
struct ViewBlock {
  glm::mat4 clip_from_relative;
  glm::vec4 eye_km;
  glm::vec4 sun;
  glm::vec4 rounding;
  glm::vec4 right;
  glm::vec4 up;
  glm::vec4 forward;
  glm::vec4 sun_at_eye;
};

/// Whether a planet has air, by its body.
bool has_air(const planet::PlanetInfo& info);

/// @param sun     unit vector toward the sun, ECEF
/// @param near_m  distance of the near plane
ViewBlock view_block(const Camera& camera, const planet::Surface& surface, const glm::dvec3& sun,
                     double near_m);
/// @param air  whether there is any
ViewBlock view_block(const Camera& camera, const geo::Ellipsoid& ellipsoid, bool air, const glm::dvec3& sun,
                     double near_m);

}  // namespace globe::render
