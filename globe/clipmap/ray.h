#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace globe::clipmap {

using glm::dvec2;
using glm::dvec3;

/// A ray that is asked where it meets triangles, and never slips through between two that share an edge.
///
/// Method: Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection": space is sheared until the
/// ray is the z axis, then each edge is tested in the plane by a cross product. Both triangles at an edge
/// compute the same product with opposite signs, and zero counts as inside for both.
class Ray {
 public:
  struct Hit {
    double distance_m;
    std::array<double, 3> weights;  ///< of the triangle's corners, sum 1, none negative
  };

  /// @param direction  unit
  Ray(const dvec3& origin, const dvec3& direction);

  const dvec3& origin() const { return origin_; }
  const dvec3& direction() const { return direction_; }

  /// Where the ray's line meets a triangle whose corners wind counter-clockwise seen from the ray's origin;
  /// the distance is negative behind it. Nothing for a triangle seen from behind or edge on.
  std::optional<Hit> meet(const dvec3& a, const dvec3& b, const dvec3& c) const;

 private:
  struct Sheared {
    dvec2 at;
    double along;
  };
  Sheared sheared(const dvec3& corner) const;

  dvec3 origin_, direction_;
  int x_, y_, z_;  ///< axes in the order of the sheared space: z the largest of the direction
  dvec3 shear_;
};

}  // namespace globe::clipmap
