#pragma once

#include <cmath>
#include <cstdint>

#include "globe/base/bit_select.h"

namespace globe::geo {

struct SineCosine {
  double sine, cosine;
};

/// Angles beyond this are to be folded by std::remainder(angle, 360), which is exact, before `sine_cosine`.
inline constexpr double kLargestAngle_deg = 0x1p40;

/// Sine and cosine of an angle in degrees, |angle| <= kLargestAngle_deg.
/// @approximation geometry.sine_cosine
/// The same bits one by one and in vectors of any width, and on every machine that keeps to IEEE 754: nothing
/// here calls a mathematical library. Trixel ids are defined on these bits.
///
/// The angle is folded to [-45, 45] exactly: 90 q is exact, and so is the difference, of numbers within a
/// factor of two (Sterbenz). Multiples of 90 degrees give 0 and +-1. At odd multiples of 45 degrees both have
/// the magnitude of the coordinates of htm::midpoint of two axes, so that these places are HTM's vertices.
/// Elsewhere polynomials in the square of the folded degrees, interpolated at the Chebyshev nodes of
/// [0, 45^2] in 60 digits: they add 0.11 (sine) and 0.002 (cosine) units in the last place to the roundings.
/// In all at most 1.6 units in the last place: 1.1, but for a sine just below a power of two whose first term
/// lies above it (tests/hard/sine_cosine_test.cpp: 1.51 seen against __float128).
GLOBE_INLINE SineCosine sine_cosine(double angle_deg) {
  constexpr double kToInteger = 0x1.8p52;  // a sum with it is rounded to an integer, which its low bits hold
  const double counted = angle_deg * (1.0 / 90.0) + kToInteger;
  std::uint64_t quarter = std::bit_cast<std::uint64_t>(counted);
  double r = angle_deg - 90.0 * (counted - kToInteger);
  // The product rounds, so that beside the border of two quarters it may have taken the wrong one.
  const std::uint64_t above = mask_of(r > 45.0), below = mask_of(r < -45.0);
  r += select(above, -90.0, select(below, 90.0, 0.0));
  quarter += below - above;  // a mask is -1

  const double z = r * r;
  const double s = ((((0x1.70d05ccb487c8p-109 * z - 0x1.6b6d7ac4053c0p-90) * z + 0x1.f4a6011417931p-72) * z -
                     0x1.c368d9f8dc379p-54) *
                        z +
                    0x1.dad94eae1041ap-37) *
                       z -
                   0x1.dbb820d942f77p-21;
  const double c = (((((0x1.d6bc3169e71bap-119 * z - 0x1.0ea2632a35b01p-99) * z + 0x1.bf623d08fff78p-81) * z -
                      0x1.f83ab5c3fba30p-63) *
                         z +
                     0x1.619b85bbc9edap-45) *
                        z -
                    0x1.09b116a83dc8ap-28) *
                       z +
                   0x1.3f6a1db141fbap-13;
  // pi / 180 in two parts.
  double sine = r * 0x1.1df46a2529d39p-6 + r * (0x1.5c1d8becdd291p-62 + z * s);
  double cosine = 1.0 - z * c;
  const double half_diagonal = 1.0 / std::sqrt(2.0);
  const std::uint64_t diagonal = mask_of(std::abs(r) == 45.0);
  sine = select(diagonal, std::copysign(half_diagonal, r), sine);
  cosine = select(diagonal, half_diagonal, cosine);

  const std::uint64_t odd = mask_of((quarter & 1) != 0);
  const std::uint64_t sine_sign = (quarter & 2) << 62, cosine_sign = ((quarter + 1) & 2) << 62;
  const auto with_sign = [](double x, std::uint64_t sign) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ sign);
  };
  return {with_sign(select(odd, cosine, sine), sine_sign), with_sign(select(odd, sine, cosine), cosine_sign)};
}

}  // namespace globe::geo
