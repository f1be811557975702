#include "globe/htm/cone.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "globe/base/error.h"

namespace globe::htm {
namespace {

/// Half the width of the border, in radians (see the header).
constexpr double kBorder = 2e-15;

double squared_chord(const dvec3& a, const dvec3& b) {
  const dvec3 d = a - b;
  return glm::dot(d, d);
}

double signed_square(double x) { return x * std::abs(x); }

}  // namespace

Cone::Cone(const dvec3& center, double radius_deg)
    : center_(center), radius_deg_(radius_deg), outside_(radius_deg > 90.0) {
  if (!(radius_deg >= 0.0 && radius_deg <= 180.0)) {
    throw UsageError("cone", "a radius of " + std::to_string(radius_deg) + " degrees is not in 0 to 180",
                     "give an angle or a length in that range");
  }
  pole_ = outside_ ? -center : center;
  const double half_angle = (outside_ ? 180.0 - radius_deg : radius_deg) * (std::numbers::pi / 360.0);
  const double chord = 2.0 * std::sin(half_angle);
  // Negative bounds stay negative when squared, so that nothing lies below them.
  contains2_ = outside_ ? signed_square(chord - kBorder) : signed_square(chord + kBorder);
  certain2_ = outside_ ? signed_square(chord - 2.0 * kBorder) : chord * chord;
  everything_ = outside_ && chord <= kBorder;
  const double possible = outside_ ? chord : chord + 2.0 * kBorder;
  possible2_ = possible * possible;
  possible_sine2_ = possible2_ * std::max(0.0, 1.0 - 0.25 * possible2_) * (1.0 + 0x1p-50);
}

bool Cone::contains(const dvec3& u) const {
  const double chord2 = squared_chord(u, pole_);
  return outside_ ? chord2 >= contains2_ : chord2 <= contains2_;
}

Relation Cone::relation(const Corners& trixel) const {
  if (everything_) return Relation::kInside;
  const Relation cap = cap_relation(trixel);
  if (!outside_ || cap == Relation::kTouches) return cap;
  return cap == Relation::kInside ? Relation::kDisjoint : Relation::kInside;
}

std::vector<dvec3> Cone::border_points() const {
  if (everything_) return {};
  // Square to the center, along the axis that it is farthest from.
  const dvec3 size = glm::abs(center_);
  const dvec3 axis = size.x <= size.y && size.x <= size.z ? dvec3{1, 0, 0}
                     : size.y <= size.z                   ? dvec3{0, 1, 0}
                                                          : dvec3{0, 0, 1};
  const double radius = radius_deg_ * (std::numbers::pi / 180.0);
  const dvec3 aside = glm::normalize(glm::cross(center_, axis));
  return {glm::normalize(std::cos(radius) * center_ + std::sin(radius) * aside)};
}

Relation Cone::cap_relation(const Corners& t) const {
  const double d0 = squared_chord(t[0], pole_);
  const double d1 = squared_chord(t[1], pole_);
  const double d2 = squared_chord(t[2], pole_);
  // A cap of up to 90 degrees is convex: with the corners it holds the trixel.
  if (std::max({d0, d1, d2}) <= certain2_) return Relation::kInside;
  if (std::min({d0, d1, d2}) <= possible2_) return Relation::kTouches;
  bool pole_inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3& a = t[k];
    const dvec3& b = t[k == 2 ? 0 : k + 1];
    const dvec3 normal = glm::cross(a + b, b - a);  // 2 a x b, from differences: exact for near corners
    const double height = glm::dot(normal, pole_ - a);
    if (height >= 0.0) continue;
    pole_inside = false;
    const double normal2 = glm::dot(normal, normal);
    // Too far from the whole great circle, and beyond it: the cap lies outside this side.
    if (height * height > possible_sine2_ * normal2) return Relation::kDisjoint;
    // Between the ends of the side the great circle comes as near as `height` says.
    const dvec3 along = glm::cross(normal, pole_);
    if (glm::dot(along, a) <= 0.0 && glm::dot(along, b) >= 0.0) return Relation::kTouches;
  }
  return pole_inside ? Relation::kTouches : Relation::kDisjoint;
}

}  // namespace globe::htm
