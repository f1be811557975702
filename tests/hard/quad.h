#pragma once

#include <cmath>

/// Quadruple precision, for the truth.
namespace hard {

__extension__ using quad = __float128;

inline constexpr double kNanometre = 1e-9;

struct QuadSineCosine {
  quad sine, cosine;
};

/// By Taylor series of the angle folded to [-45, 45] degrees, 30 digits.
inline QuadSineCosine quad_sine_cosine(double angle_deg) {
  const double folded = std::remainder(angle_deg, 90.0);
  const int quarter = static_cast<int>(std::lround((std::remainder(angle_deg, 360.0) - folded) / 90.0)) & 3;
  // pi to 33 digits as a sum of three doubles.
  const quad pi = static_cast<quad>(3.141592653589793116) + static_cast<quad>(1.224646799147353207e-16) -
                  static_cast<quad>(2.994769809718339666e-33);
  const quad x = static_cast<quad>(folded) * pi / 180;
  quad sine = 0, cosine = 0, term = 1;
  for (int k = 0; k < 40; ++k) {
    const quad signed_term = k % 4 < 2 ? term : -term;
    (k % 2 == 0 ? cosine : sine) += signed_term;
    term *= x / (k + 1);
  }
  switch (quarter) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

inline quad square_root(quad x) {
  quad root = std::sqrt(static_cast<double>(x));
  for (int step = 0; step < 2; ++step) root = (root + x / root) / 2;
  return root;
}

struct QuadVector {
  quad x, y, z;
};

inline QuadVector operator+(const QuadVector& a, const QuadVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline quad dot(const QuadVector& a, const QuadVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline QuadVector cross(const QuadVector& a, const QuadVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline QuadVector normalized(const QuadVector& a) {
  const quad scale = 1 / square_root(dot(a, a));
  return {a.x * scale, a.y * scale, a.z * scale};
}

}  // namespace hard
