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

Horizon::Horizon(const geo::Ellipsoid& ellipsoid, double lowest_m, const dvec3& camera_ecef) {
  // The planet's shape, shrunk about its centre until its support function is nowhere above that of the
  // surface at height lowest_m: a convex body with a smaller support function lies inside.
  shortest_ = std::min(ellipsoid.a, ellipsoid.b());
  longest_ = std::max(ellipsoid.a, ellipsoid.b());
  const double shrunk = 1.0 + lowest_m / (lowest_m < 0.0 ? shortest_ : longest_);
  scale_ = 1.0 / (dvec3(ellipsoid.a, ellipsoid.a, ellipsoid.b()) * std::max(shrunk, 1e-9));
  widest_ = std::max(scale_.x, scale_.z);
  const dvec3 camera = camera_ecef * scale_;
  camera_distance_ = glm::length(camera);
  to_camera_ = camera_distance_ > 0.0 ? camera / camera_distance_ : dvec3(0, 0, 1);
  camera_angle_ = camera_distance_ > 1.0 ? std::acos(1.0 / camera_distance_) : -1.0;
}

bool Horizon::sees(const dvec3& centre_ecef, double radius_m, double highest_m) const {
  constexpr double kRounding = 1e-7;  // acos of nearly 1 is no better than 2e-8
  if (camera_angle_ < 0.0) return true;
  const dvec3 centre = centre_ecef * scale_;
  const double radius = radius_m * widest_;
  const double distance = glm::length(centre);
  if (distance <= radius) return true;
  // In the shadow behind the horizon's plane: the cone from the camera around the unit sphere, its axis down.
  const double sine = 1.0 / camera_distance_;
  const double up = glm::dot(centre, to_camera_);
  const double aside = std::sqrt(std::max(distance * distance - up * up, 0.0));
  const double inside = (camera_distance_ - up) * sine - aside * std::sqrt(1.0 - sine * sine);
  if (up + radius <= sine && inside >= radius + kRounding) return false;
  // Or too far round the planet for its highest point: scaled, the surface at a height lies within this
  // radius, by its support function again.
  const double by_height = widest_ * shortest_ * (1.0 + highest_m / (highest_m < 0.0 ? longest_ : shortest_));
  const double top = std::min(distance + radius, by_height);
  const double own_angle = top > 1.0 ? std::acos(1.0 / top) : 0.0;
  const double half_width = std::asin(radius / distance);
  const double apart = std::acos(std::clamp(up / distance, -1.0, 1.0));
  return apart - half_width <= camera_angle_ + own_angle + kRounding;
}

}  // namespace globe::clipmap
