#include "globe/clipmap/culling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace globe::clipmap {

Frustum::Frustum(const dvec3& forward_axis, const dvec3& right, const dvec3& up, double tan_x, double tan_y)
    : sides{glm::normalize(forward_axis * tan_x + right), glm::normalize(forward_axis * tan_x - right),
            glm::normalize(forward_axis * tan_y + up), glm::normalize(forward_axis * tan_y - up)},
      forward(forward_axis) {}

bool Frustum::sees(const dvec3& centre, double radius) const {
  if (glm::dot(centre, forward) < -radius) return false;
  return std::all_of(sides.begin(), sides.end(),
                     [&](const dvec3& n) { return glm::dot(centre, n) >= -radius; });
}

Horizon::Horizon(const geo::Ellipsoid& ellipsoid, double lowest_m, const dvec3& camera_ecef)
    : occluder_(std::min(ellipsoid.a, ellipsoid.b()) + lowest_m) {
  const double distance = glm::length(camera_ecef);
  to_camera_ = distance > 0.0 ? camera_ecef / distance : dvec3(0, 0, 1);
  camera_angle_ = distance > occluder_ && occluder_ > 0.0 ? std::acos(occluder_ / distance) : -1.0;
}

bool Horizon::sees(const dvec3& centre, double radius) const {
  if (camera_angle_ < 0.0) return true;
  const double distance = glm::length(centre);
  if (distance <= radius) return true;
  const double top = distance + radius;
  const double own_angle = top > occluder_ ? std::acos(occluder_ / top) : 0.0;
  const double half_width = std::asin(std::min(1.0, radius / distance));
  const double apart = std::acos(std::clamp(glm::dot(centre, to_camera_) / distance, -1.0, 1.0));
  return apart - half_width <= camera_angle_ + own_angle;
}

}  // namespace globe::clipmap
