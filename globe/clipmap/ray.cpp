#include "globe/clipmap/ray.h"

#include <cmath>
#include <utility>

namespace globe::clipmap {
namespace {

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

Ray::Ray(const dvec3& origin, const dvec3& direction) : origin_(origin), direction_(direction), z_(0) {
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(direction[axis]) > std::abs(direction[z_])) z_ = axis;
  }
  x_ = (z_ + 1) % 3;
  y_ = (z_ + 2) % 3;
  if (direction[z_] < 0.0) std::swap(x_, y_);  // or triangles would wind the other way
  shear_ = dvec3(direction[x_], direction[y_], 1.0) / direction[z_];
}

Ray::Sheared Ray::sheared(const dvec3& corner) const {
  const dvec3 from = corner - origin_;
  return {{from[x_] - shear_.x * from[z_], from[y_] - shear_.y * from[z_]}, shear_.z * from[z_]};
}

std::optional<Ray::Hit> Ray::meet(const dvec3& a, const dvec3& b, const dvec3& c) const {
  const Sheared p = sheared(a), q = sheared(b), r = sheared(c);
  // Looked along the ray x points right and y down: what winds counter-clockwise there has a negative area.
  const double u = cross(r.at, q.at);
  const double v = cross(p.at, r.at);
  const double w = cross(q.at, p.at);
  if (u < 0.0 || v < 0.0 || w < 0.0) return std::nullopt;
  const double sum = u + v + w;
  if (sum == 0.0) return std::nullopt;
  return Hit{(u * p.along + v * q.along + w * r.along) / sum, {u / sum, v / sum, w / sum}};
}

}  // namespace globe::clipmap
