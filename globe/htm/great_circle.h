#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "globe/htm/predicates.h"

namespace globe::htm {

/// The great circle from a to b, made ready to be asked often on which side points lie.
///
/// The sign is that of det(a, b, p) in exact arithmetic, as `orientation` gives it. The filter is
/// n · (p - a), n = (a + b) x (b - a) = 2 a x b: with u = 2^-53 the error of n is below 24 u |b - a|, that of
/// the difference and the product below 8 u |n| |p - a|, and |n| <= 2 |b - a|.
class GreatCircle {
 public:
  GreatCircle() = default;
  GreatCircle(const dvec3& a, const dvec3& b)
      : a_(a), b_(b), normal_(glm::cross(a + b, b - a)), error_(kError * sum_of_magnitudes(b - a)) {}

  /// 1: p lies to the left; 0: on the circle, exactly; -1: to the right.
  int side(const dvec3& p) const {
    const dvec3 from_a = p - a_;
    const double height = glm::dot(normal_, from_a);
    const double error = error_ * sum_of_magnitudes(from_a) + kUnderflow;
    if (height > error) return 1;
    if (height < -error) return -1;
    return orientation(a_, b_, p).sign;
  }

  const dvec3& a() const { return a_; }
  const dvec3& b() const { return b_; }
  const dvec3& normal() const { return normal_; }

 private:
  static constexpr double kError = 40.0 * 0x1p-53;
  static constexpr double kUnderflow = 0x1p-1000;

  static double sum_of_magnitudes(const dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

  dvec3 a_{0.0}, b_{0.0}, normal_{0.0};
  double error_ = 0;
};

}  // namespace globe::htm
