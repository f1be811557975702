#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace globe::htm {

/// A sum of products of three doubles, kept without any rounding.
///
/// One fixed-point number in two's complement, wide enough for every product of three doubles of magnitude
/// below 2^100, subnormal ones included: the mantissas multiply to 159 bits, which are added at their place.
/// The other classic, expansions of doubles (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates"), loses its error terms to underflow near the axes,
/// where coordinates of 1e-300 are ordinary (latitude 1e-298).
class ExactSum {
 public:
  /// Adds a * b * c. REQUIRES: finite, each of magnitude below 2^100; at most 2^20 calls.
  void add(double a, double b, double c);

  /// -1, 0 or 1: the sign of the exact sum.
  int sign() const;

 private:
  /// Exponent of the lowest bit: three times that of the last mantissa bit of the smallest subnormal.
  static constexpr int kExponentOfBit0 = -3378;
  /// 3840 bits: 3378 below one, 300 of the largest product, 20 of the count of calls, and the sign.
  static constexpr std::size_t kWords = 60;
  std::array<std::uint64_t, kWords> words_{};  // least significant first
};

}  // namespace globe::htm
