#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace globe::render {

enum class RoomSide { kOutside, kAcross, kInside };

/// A part of the planet whose ground something else draws: what stands over a rectangle of a plane. The
/// globe's own ground ends at its sides, which are planes.
struct Room {
  glm::dvec3 origin;  ///< ECEF metres
  glm::dmat3 axes;    ///< columns: along the rectangle's sides, and up, ECEF unit vectors
  glm::dvec2 low;     ///< the rectangle in the plane of the first two axes through the origin, metres
  glm::dvec2 high;

  /// How far a place lies inside of its four sides, metres; west, east, south, north as the axes have them.
  glm::dvec4 inside_m(const glm::dvec3& ecef) const;
  bool holds(const glm::dvec3& ecef) const;
};

/// On which side of the room's sides a ball lies; kAcross when that is not certain.
RoomSide side_of(const Room& room, const glm::dvec3& centre, double radius);

}  // namespace globe::render
