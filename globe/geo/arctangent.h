#pragma once

#include <cmath>

#include "globe/base/bit_select.h"

namespace globe::geo {

/// The angle of (x, y) from the x axis in degrees, [-180, 180], as std::atan2 gives it in radians; 0 for the
/// origin. Neither may be infinite or NaN.
///
/// The same bits one by one and in vectors of any width, and on every machine that keeps to IEEE 754: nothing
/// here calls a mathematical library. Multiples of 45 degrees come out exactly.
///
/// The tangent is folded to [-tan 22.5, tan 22.5] degrees, where the rational function of Cephes' atan.c
/// (Moshier 1995, relative error 1.8e-16) takes over. Error at most 5e-14 degrees, 6 nm on the Earth
/// (tests/unit/geo/arctangent_test.cpp). @approximation geometry.arctangent
GLOBE_INLINE double arctangent(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  const std::uint64_t steep = mask_of(ay > ax);
  const double low = select(steep, ax, ay), high = select(steep, ay, ax);
  constexpr double kTangentOfEighth = 0x1.a827999fcef32p-2;  // tan(22.5 degrees)
  const std::uint64_t far = mask_of(low > kTangentOfEighth * high);
  const double above = select(far, low - high, low);
  const double below = select(far, low + high, high);
  const double t = above / select(mask_of(below == 0.0), 1.0, below);
  const double z = t * t;
  const double p =
      (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
       1.228866684490136173410e2) *
          z -
      6.485021904942025371773e1;
  const double q =
      ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) *
           z +
       4.853903996359136964868e2) *
          z +
      1.945506571482613964425e2;
  constexpr double kDegrees = 0x1.ca5dc1a63c1f8p+5;  // 180 / pi
  double angle = select(far, 45.0, 0.0) + kDegrees * (t + t * (z * p / q));
  angle = select(steep, 90.0 - angle, angle);
  angle = select(mask_of(x < 0.0), 180.0 - angle, angle);
  return std::copysign(angle, y);
}

}  // namespace globe::geo
