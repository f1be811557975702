#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace globe::scene {

/// A curve on the unit sphere through places at times, smooth in velocity.
///
/// Bezier curves of great-circle arcs (Shoemake 1985, "Animating rotation with quaternion curves", by de
/// Casteljau's construction). The velocity at a place is that of a parabola through it and its neighbours, no
/// faster than twice the slower of its two sides: where one side rests, so does the place. Between antipodes
/// the way leads over the north pole, from pole to pole along the meridian of 0.
class SphereCurve {
 public:
  /// @param stops  where the curve rests in any case
  /// REQUIRES: two or more times, increasing, and as many places (unit) and stops
  SphereCurve(std::vector<double> times, std::vector<glm::dvec3> places, const std::vector<bool>& stops);

  /// The first or last place outside the times.
  glm::dvec3 at(double time) const;

  /// Unit direction in which the k-th place is passed, or left, or reached; north where nothing moves.
  glm::dvec3 direction(std::size_t k) const;

 private:
  std::vector<double> times_;
  std::vector<glm::dvec3> places_;
  std::vector<glm::dvec3> velocity_;  ///< radians a unit of time
};

}  // namespace globe::scene
