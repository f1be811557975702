#pragma once

#include <cmath>
#include <cstdint>

#include "globe/base/bit_select.h"

// The fast way from a direction to its trixel: no corner is ever computed. It either names the trixel that
// trixel_by_walk names, for certain, or says that it cannot tell.
//
// Weights. A direction u in a trixel with corners C0, C1, C2 is a sum w0 C0 + w1 C1 + w2 C2 of weights >= 0;
// only their ratios matter. In a root they are |x|, |y|, |z|. Let t = w0 + w1 + w2. With respect to the
// corners of child k and the chord midpoints beside it they are 2 wk - t, 2 wi, 2 wj; with respect to the
// chord midpoints, the corners of the middle child, t - 2 w0, t - 2 w1, t - 2 w2. So u is in child k when
// 2 wk > t, else in the middle. HTM's vertex is the chord midpoint (a + b) / 2 over its length l = cos(s /
// 2), s the side: its weight is to be multiplied by l. Of the sides one number is kept each, q = sin(s /
// 2)^2, from which
//   l = sqrt(1 - q),  q of half that side = (1 - l) / 2,
//   q of the side between two chord midpoints = (qk - (li - lj)^2) / (4 li lj), k the side it is parallel to.
// From some level on series do, and then q / 4 and 1 - q / 2. After kWalked levels l = 1 is close enough:
// what is left is the binary digits of w / t.
//
// Digits. Label the corners of all trixels by the corner of the root they come from (in the middle child the
// corner opposite k is k). Of the three binary digits of w / t at a level at most one is set outside and at
// least two are inside trixels that are upside down, so their majority tells which way up the trixel is, and
// the digits that differ from it which corner's child is taken. HTM numbers the corners of child k from k on,
// so its digit is the label less that of the last corner child before, modulo 3; all levels at once.
//
// Error bound. Let e = 2^-53. Each step above, taken in rounded arithmetic or with a truncated l, is the
// exact step for a direction moved by a little; what is bounded is the sum of these moves (radians), because
// the trixel found holds the moved direction. A relative error r of the weights moves it by at most 3 r h /
// n, h the trixel's longest side, n >= 0.577 the distance of its plane from the centre; multiplying the
// weights of new corners by l too much or too little by r moves it by at most 2/3 r h. Sides at level n are
// at most 2.46 / 2^n, heights at least 1.1 / 2^n (both: limits, reached from below and above; n >= 1), and l
// differs from 1 by at most h^2 / 8 (1 + h^2). Then
//   rounding:            10 e a level and twice that with q's own                   <= 320 e < 3.6e-14
//   series instead of roots: terms of q^3 from level kWalked - 6 on, of q^2 from kWalked - 3 on
//                                                                         <= 0.11 * 8^-kWalked (kWalked >=
//                                                                         11)
//   l = 1 from kWalked on:   sum over n of 2/3 h_n^2 / 8 h_(n+1) = h^3 / 21, h = h_kWalked
//                                                                         <= 0.71 * 8^-kWalked
// The walk takes signs on rounded corners. They lie within 110 e = 1.3e-14 of the ideal ones (each midpoint
// adds 2 e, and hands on the errors of its ends over l), and a great circle through two of them within four
// times that, 5.2e-14, of the ideal one wherever it crosses their trixel. So let u be farther than
//   8^-kWalked + 2^-43    (2^-43 = 1.13e-13 > 3.6e-14 + 5.2e-14)
// within the trixel found from each of its ideal sides, moves included: then the disc of that radius about u
// lies in that trixel and in all its ancestors, no side of any child of them crosses it, and each of the
// walk's signs is that of the ideal corners. Distance from a side is at least weight times height, and the
// height is 1.1 / 2^level, so it is enough that each w / t is farther than 2^level (8^-kWalked + 2^-43)
// from an integer, in units of cells: `margin`. Measured: tests/hard/descent_test.cpp.
namespace globe::htm {

/// A direction on its way down: weights, q of the side opposite each corner, and one bit a level for each
/// corner, set where its child was taken (last level lowest).
struct Descent {
  double w0, w1, w2;
  double q0, q1, q2;
  std::uint64_t c0, c1, c2;
};

/// A root's number (kFirstRoot ..) and the descent at its top. Where a component is 0 the root may not be the
/// owner; such directions lie on a side, so that no descent from there will be certain.
struct Top {
  std::uint64_t root;
  Descent descent;
};

GLOBE_INLINE Top top_of(double x, double y, double z) {
  const std::uint64_t west = mask_of(x < 0.0), south_y = mask_of(y < 0.0), north = mask_of(z >= 0.0);
  // Octants 0..3 eastwards; S0..S3 are octants 0..3, N0..N3 octants 3..0. Corner 1 is the pole.
  const std::uint64_t octant = (south_y & 2) | ((west ^ south_y) & 1);
  const std::uint64_t y_first = west ^ south_y ^ north;
  const double ax = std::abs(x), ay = std::abs(y);
  return {8 + (octant ^ (north & 7)),
          {select(y_first, ay, ax), std::abs(z), select(y_first, ax, ay), 0.5, 0.5, 0.5, 0, 0, 0}};
}

/// Half the way from q and l of three sides to those of the next level: of the sides beside a corner of the
/// parent (halves) and of the sides between midpoints.
struct Sides {
  double l0, l1, l2, half0, half1, half2, inner0, inner1, inner2;
};

GLOBE_INLINE Sides sides_by_roots(double q0, double q1, double q2, double l0, double l1, double l2) {
  const double scale = 0.25 / (l0 * l1 * l2);
  return {l0,
          l1,
          l2,
          0.5 - 0.5 * l0,
          0.5 - 0.5 * l1,
          0.5 - 0.5 * l2,
          (q0 - (l1 - l2) * (l1 - l2)) * l0 * scale,
          (q1 - (l2 - l0) * (l2 - l0)) * l1 * scale,
          (q2 - (l0 - l1) * (l0 - l1)) * l2 * scale};
}

GLOBE_INLINE Sides sides_by_series(double q0, double q1, double q2) {
  const auto l = [](double q) { return 1.0 - q * (0.5 + 0.125 * q); };
  const auto half = [](double q) { return q * (0.25 + 0.0625 * q); };
  const auto inner = [](double q, double qi, double qj) {
    return q * (0.25 + 0.125 * (qi + qj)) - 0.0625 * (qi - qj) * (qi - qj);
  };
  return {l(q0),
          l(q1),
          l(q2),
          half(q0),
          half(q1),
          half(q2),
          inner(q0, q1, q2),
          inner(q1, q2, q0),
          inner(q2, q0, q1)};
}

GLOBE_INLINE Sides sides_of_small(double q0, double q1, double q2) {
  const double half0 = 0.25 * q0, half1 = 0.25 * q1, half2 = 0.25 * q2;
  return {1.0 - 0.5 * q0, 1.0 - 0.5 * q1, 1.0 - 0.5 * q2, half0, half1, half2, half0, half1, half2};
}

template <int kLevel, int kWalked>
GLOBE_INLINE Sides sides(double q0, double q1, double q2) {
  if constexpr (kLevel == 1) {
    // Sides of 60 degrees (q = 1/4) and of 45 degrees, and nothing else.
    const auto l = [](double q) {
      return select(mask_of(q > 0.2), 0.86602540378443864676, 0.92387953251128675613);
    };
    return sides_by_roots(q0, q1, q2, l(q0), l(q1), l(q2));
  } else if constexpr (kLevel < kWalked - 6) {
    return sides_by_roots(q0, q1, q2, std::sqrt(1.0 - q0), std::sqrt(1.0 - q1), std::sqrt(1.0 - q2));
  } else if constexpr (kLevel < kWalked - 3) {
    return sides_by_series(q0, q1, q2);
  } else {
    return sides_of_small(q0, q1, q2);
  }
}

/// One level down, of a descent to kWalked.
template <int kLevel, int kWalked>
GLOBE_INLINE Descent step_down(const Descent& d) {
  const Sides s = sides<kLevel, kWalked>(d.q0, d.q1, d.q2);
  const double t = d.w0 + d.w1 + d.w2;
  const double twice0 = d.w0 + d.w0, twice1 = d.w1 + d.w1, twice2 = d.w2 + d.w2;
  const double over0 = twice0 - t, over1 = twice1 - t, over2 = twice2 - t;
  const std::uint64_t in0 = mask_of(over0 > 0.0), in1 = mask_of(over1 > 0.0), in2 = mask_of(over2 > 0.0);
  const std::uint64_t middle = ~(in0 | in1 | in2);
  const std::uint64_t own0 = in0 | middle, own1 = in1 | middle, own2 = in2 | middle;
  const double l0 = select(in0, 1.0, select(in1, s.l2, select(in2, s.l1, s.l0)));
  const double l1 = select(in1, 1.0, select(in2, s.l0, select(in0, s.l2, s.l1)));
  const double l2 = select(in2, 1.0, select(in0, s.l1, select(in1, s.l0, s.l2)));
  // in0.. are -1 where set: doubling and adding 1 is subtracting them.
  return {select(own0, std::abs(over0), twice0) * l0,
          select(own1, std::abs(over1), twice1) * l1,
          select(own2, std::abs(over2), twice2) * l2,
          select(own0, s.inner0, s.half0),
          select(own1, s.inner1, s.half1),
          select(own2, s.inner2, s.half2),
          d.c0 + d.c0 - in0,
          d.c1 + d.c1 - in1,
          d.c2 + d.c2 - in2};
}

/// The descent from kLevel to kWalked.
template <int kLevel, int kWalked>
GLOBE_INLINE Descent descend(const Descent& d) {
  if constexpr (kLevel == kWalked) {
    return d;
  } else {
    return descend<kLevel + 1, kWalked>(step_down<kLevel, kWalked>(d));
  }
}

/// Eleven levels are walked to reach level 22, where one direction in 350 is left to the exact walk; 14
/// beyond.
inline constexpr int kShort = 11, kLong = 14, kDeepestOfShort = 22;

/// The level that a descent of kWalked steps is to end at, and what depends on it alone.
struct Goal {
  int level;     ///< kWalked or more
  int digits;    ///< levels left after the walk
  double cells;  ///< 2^digits
  double margin;
};

template <int kWalked>
inline Goal goal_at(int level) {
  const int deep = level < kWalked ? kWalked : level;
  return {deep, deep - kWalked, std::ldexp(1.0, deep - kWalked),
          std::ldexp(1.0, deep) * (std::ldexp(1.0, -3 * kWalked) + 0x1p-43)};
}

/// Low bits of HTM's digits, high bits: one of each a level.
struct Digits {
  std::uint64_t low, high;
};

/// @param c0, c1, c2  as in Descent, of `level` levels
GLOBE_INLINE Digits digits_of(std::uint64_t c0, std::uint64_t c1, std::uint64_t c2, int level) {
  const std::uint64_t top = std::uint64_t{1} << level;
  // At each level the label of the last corner child before it: r1 set for 1, r2 for 2, neither for 0, as at
  // the root. Looks 1, 2, 4 .. levels up where nothing has been found yet.
  std::uint64_t found = (c0 | c1 | c2 | top) >> 1, r1 = c1 >> 1, r2 = c2 >> 1;
  const auto look_up = [&](int levels) {
    r1 |= (r1 >> levels) & ~found;
    r2 |= (r2 >> levels) & ~found;
    found |= found >> levels;
  };
  look_up(1);
  look_up(2);
  look_up(4);
  look_up(8);
  look_up(16);
  const std::uint64_t r0 = ~(r1 | r2);
  const std::uint64_t middle = ~(c0 | c1 | c2) & (top - 1);
  return {(c1 & r0) | (c2 & r1) | (c0 & r2) | middle, (c2 & r0) | (c0 & r1) | (c1 & r2) | middle};
}

/// Puts a zero before each of the low 32 bits.
GLOBE_INLINE std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 16) & 0x0000FFFF0000FFFFU;
  v = (v | v << 8) & 0x00FF00FF00FF00FFU;
  v = (v | v << 4) & 0x0F0F0F0F0F0F0F0FU;
  v = (v | v << 2) & 0x3333333333333333U;
  return (v | v << 1) & 0x5555555555555555U;
}

/// What a descent found: a trixel's id at the goal's level, and whether it is certain (a mask).
struct Found {
  std::uint64_t id;
  std::uint64_t certain;
};

/// The levels after the walk, from the binary digits of the weights.
GLOBE_INLINE Found arrive(std::uint64_t root, const Descent& d, const Goal& goal) {
  constexpr double kToInteger = 0x1p52;  // a sum with it is rounded to an integer, which its low bits hold
  const double scale = goal.cells / (d.w0 + d.w1 + d.w2);
  const double p0 = d.w0 * scale, p1 = d.w1 * scale, p2 = d.w2 * scale;
  const double n0 = p0 + kToInteger, n1 = p1 + kToInteger, n2 = p2 + kToInteger;
  const double rest0 = p0 - (n0 - kToInteger), rest1 = p1 - (n1 - kToInteger), rest2 = p2 - (n2 - kToInteger);
  // Written so that what is not a number is not certain.
  const std::uint64_t certain = mask_of(std::abs(rest0) >= goal.margin) &
                                mask_of(std::abs(rest1) >= goal.margin) &
                                mask_of(std::abs(rest2) >= goal.margin);
  const auto floor_bits = [&](double n, double rest) {
    return (std::bit_cast<std::uint64_t>(n) + mask_of(rest < 0.0)) & ((std::uint64_t{1} << goal.digits) - 1);
  };
  const std::uint64_t b0 = floor_bits(n0, rest0), b1 = floor_bits(n1, rest1), b2 = floor_bits(n2, rest2);
  const std::uint64_t majority = (b0 & b1) | (b2 & (b0 | b1));
  const Digits digits =
      digits_of(d.c0 << goal.digits | (b0 ^ majority), d.c1 << goal.digits | (b1 ^ majority),
                d.c2 << goal.digits | (b2 ^ majority), goal.level);
  return {root << (2 * goal.level) | spread(digits.low) | spread(digits.high) << 1, certain};
}

/// Whether a direction is neither so long nor so short that weights might overflow or lose digits. (A mask.)
GLOBE_INLINE std::uint64_t is_of_usual_length(const Descent& top) {
  const double length = top.w0 + top.w1 + top.w2;
  return mask_of(length > 0x1p-500) & mask_of(length < 0x1p500);
}

/// The trixel of a direction at the goal's level.
template <int kWalked>
GLOBE_INLINE Found find(double x, double y, double z, const Goal& goal) {
  const Top top = top_of(x, y, z);
  Found found = arrive(top.root, descend<0, kWalked>(top.descent), goal);
  found.certain &= is_of_usual_length(top.descent);
  return found;
}

}  // namespace globe::htm
