#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "globe/base/vector_width.h"

namespace globe::planet {

using glm::dvec3;
using glm::vec3;

/// Noise in space, made of integer hashes, sums and products only: the same bits on every machine.
///
/// What is inline here is written without branches for the body of a loop over kLanes places, which the
/// compiler turns into vector code.

/// So many places are worked out side by side.
inline constexpr std::size_t kLanes = 16;
using LaneFloats = std::array<float, kLanes>;
struct LanePlaces {
  std::array<double, kLanes> x, y, z;

  void set(std::size_t k, const dvec3& p) {
    x[k] = p.x;
    y[k] = p.y;
    z[k] = p.z;
  }
  dvec3 get(std::size_t k) const { return {x[k], y[k], z[k]}; }
};

GLOBE_INLINE float lesser(float a, float b) { return a < b ? a : b; }
GLOBE_INLINE float greater(float a, float b) { return a > b ? a : b; }

namespace lattice {

/// Well-mixed 32 bits: Hughes' "lowbias32" finaliser.
GLOBE_INLINE std::uint32_t finish(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ (h >> 16);
}

inline constexpr std::uint32_t kX = 0x8da6b343u;
inline constexpr std::uint32_t kY = 0xd8163841u;
inline constexpr std::uint32_t kZ = 0xcb1ab31fu;

GLOBE_INLINE std::uint32_t scaled(int v, std::uint32_t factor) {
  return static_cast<std::uint32_t>(v) * factor;
}

/// Largest integer not above v, |v| < 2^31.
GLOBE_INLINE double floor_of(double v) {
  const auto truncated = static_cast<double>(static_cast<int>(v));
  return truncated - (v < truncated ? 1.0 : 0.0);
}

/// The lattice cell that holds a point: what its lower and upper corners add to hashes, the place inside, and
/// how much its upper corners weigh there.
struct Axis {
  std::uint32_t low, high;
  float f, w;
};
GLOBE_INLINE float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }
GLOBE_INLINE float fade_slope(float t) { return 30.0f * t * t * (t * (t - 2.0f) + 1.0f); }
GLOBE_INLINE Axis axis_of(double v, std::uint32_t factor, std::uint32_t seed) {
  const double floor = floor_of(v);
  const auto cell = static_cast<int>(floor);
  const auto f = static_cast<float>(v - floor);
  return {seed ^ scaled(cell, factor), seed ^ scaled(cell + 1, factor), f, fade(f)};
}
struct Cell {
  Axis x, y, z;
};
GLOBE_INLINE Cell cell_of(std::uint32_t seed, const dvec3& p) {
  return {axis_of(p.x, kX, seed), axis_of(p.y, kY, 0), axis_of(p.z, kZ, 0)};
}

/// One of the eight corners of a cell: its hash, the place seen from it, the three factors of its weight.
struct Corner {
  std::uint32_t hash;
  float x, y, z, wx, wy, wz;
};
template <bool kUpperX, bool kUpperY, bool kUpperZ>
GLOBE_INLINE Corner corner_of(const Cell& c) {
  return {finish((kUpperX ? c.x.high : c.x.low) ^ (kUpperY ? c.y.high : c.y.low) ^
                 (kUpperZ ? c.z.high : c.z.low)),
          kUpperX ? c.x.f - 1.0f : c.x.f,
          kUpperY ? c.y.f - 1.0f : c.y.f,
          kUpperZ ? c.z.f - 1.0f : c.z.f,
          kUpperX ? c.x.w : 1.0f - c.x.w,
          kUpperY ? c.y.w : 1.0f - c.y.w,
          kUpperZ ? c.z.w : 1.0f - c.z.w};
}

/// Ten bits of a hash as [-1, 1].
template <int kShift>
GLOBE_INLINE float component(std::uint32_t hash) {
  return static_cast<float>(static_cast<int>((hash >> kShift) & 1023u)) * (2.0f / 1023.0f) - 1.0f;
}

}  // namespace lattice

/// A well-mixed 32-bit hash of a lattice point.
GLOBE_INLINE std::uint32_t lattice_hash(std::uint32_t seed, int x, int y, int z) {
  using namespace lattice;
  return finish(seed ^ scaled(x, kX) ^ scaled(y, kY) ^ scaled(z, kZ));
}

/// Uniform in [0, 1) from a hash.
GLOBE_INLINE float unit_from_hash(std::uint32_t hash) {
  return static_cast<float>(static_cast<int>(hash >> 8)) * 0x1p-24f;
}

struct NoiseSample {
  float value;    ///< about [-1, 1], root mean square 0.4
  vec3 gradient;  ///< of value by p
};

namespace lattice {

/// What a corner adds to gradient noise.
template <bool kUpperX, bool kUpperY, bool kUpperZ>
GLOBE_INLINE NoiseSample gradient_part(const Cell& cell, const vec3& dw) {
  const Corner c = corner_of<kUpperX, kUpperY, kUpperZ>(cell);
  const float gx = component<2>(c.hash), gy = component<12>(c.hash), gz = component<22>(c.hash);
  const float dot = gx * c.x + gy * c.y + gz * c.z;
  const float weight = c.wx * c.wy * c.wz;
  return {weight * dot,
          {weight * gx + (kUpperX ? dw.x : -dw.x) * c.wy * c.wz * dot,
           weight * gy + (kUpperY ? dw.y : -dw.y) * c.wx * c.wz * dot,
           weight * gz + (kUpperZ ? dw.z : -dw.z) * c.wx * c.wy * dot}};
}

GLOBE_INLINE NoiseSample operator+(const NoiseSample& a, const NoiseSample& b) {
  return {a.value + b.value,
          {a.gradient.x + b.gradient.x, a.gradient.y + b.gradient.y, a.gradient.z + b.gradient.z}};
}

}  // namespace lattice

/// Gradient noise with continuous second derivatives; one cell is one unit of p.
/// Source: Perlin 2002, "Improving noise"; derivatives as in Quilez, "Gradient noise derivatives".
GLOBE_INLINE NoiseSample gradient_noise(std::uint32_t seed, const dvec3& p) {
  using namespace lattice;
  const lattice::Cell c = cell_of(seed, p);
  const vec3 dw{fade_slope(c.x.f), fade_slope(c.y.f), fade_slope(c.z.f)};
  const NoiseSample sum =
      ((gradient_part<false, false, false>(c, dw) + gradient_part<false, false, true>(c, dw)) +
       (gradient_part<false, true, false>(c, dw) + gradient_part<false, true, true>(c, dw))) +
      ((gradient_part<true, false, false>(c, dw) + gradient_part<true, false, true>(c, dw)) +
       (gradient_part<true, true, false>(c, dw) + gradient_part<true, true, true>(c, dw)));
  constexpr float kScale = 1.5f;
  return {sum.value * kScale, {sum.gradient.x * kScale, sum.gradient.y * kScale, sum.gradient.z * kScale}};
}

/// Octaves of gradient noise at kLanes places times `scale`, frequencies 1, 2, 4, ..., amplitudes 1, gain,
/// gain², ...
LaneFloats fractal_noise(std::uint32_t seed, const LanePlaces& p, double scale, int octaves, float gain);

/// Octaves of 1 - |noise|, each weighted by the one before: crests carry more crests, valleys stay smooth.
/// About [0, 1]. Source: Musgrave's ridged multifractal, "Texturing and Modeling", chapter 16.
LaneFloats ridged_noise(std::uint32_t seed, const LanePlaces& p, double scale, int octaves, float gain);

/// sin(2 pi turns), within 0.0011, for turns up to a million; continuous in slope.
GLOBE_INLINE float sine_of_turns(float turns) {
  constexpr float kToInteger = 12582912.0f;  // 1.5 * 2^23: adding it leaves no bits for a fraction
  const float x = turns - ((turns + kToInteger) - kToInteger);
  const float y = 8.0f * x - 16.0f * x * std::abs(x);
  return y + 0.225f * (y * std::abs(y) - y);
}

struct Stripes {
  float cosine;  ///< 1 on a stripe's crest, -1 between two
  float sine;    ///< its rate of change along `across`, per radian of phase, is -sine
};

namespace lattice {

/// What a corner adds to stripe noise.
template <bool kUpperX, bool kUpperY, bool kUpperZ>
GLOBE_INLINE Stripes stripe_part(const Cell& cell, const vec3& along, float shift) {
  const Corner c = corner_of<kUpperX, kUpperY, kUpperZ>(cell);
  const float turns = c.x * along.x + c.y * along.y + c.z * along.z + (unit_from_hash(c.hash) + shift);
  const float weight = c.wx * c.wy * c.wz;
  return {weight * sine_of_turns(turns + 0.25f), weight * sine_of_turns(turns)};
}

GLOBE_INLINE Stripes operator+(const Stripes& a, const Stripes& b) {
  return {a.cosine + b.cosine, a.sine + b.sine};
}

}  // namespace lattice

/// Stripes whose normal is `across` (unit), `waves` to a cell; their phase is random in each cell and blended
/// between cells, so that stripes fork and end. `across` and
/// `shift` (turns) may vary slowly from place to place.
/// Source: the stripe noise of Rune Skovbo Johansen's erosion filter (2023), here in space.
GLOBE_INLINE Stripes stripe_noise(std::uint32_t seed, const dvec3& p, const vec3& across, float waves,
                                  float shift) {
  using namespace lattice;
  const lattice::Cell c = cell_of(seed, p);
  const vec3 along{waves * across.x, waves * across.y, waves * across.z};
  const Stripes sum =
      ((stripe_part<false, false, false>(c, along, shift) +
        stripe_part<false, false, true>(c, along, shift)) +
       (stripe_part<false, true, false>(c, along, shift) + stripe_part<false, true, true>(c, along, shift))) +
      ((stripe_part<true, false, false>(c, along, shift) + stripe_part<true, false, true>(c, along, shift)) +
       (stripe_part<true, true, false>(c, along, shift) + stripe_part<true, true, true>(c, along, shift)));
  // Where cells cancel each other stripes would fade; raise them, but leave true dislocations smooth.
  const float inverse = 1.0f / std::sqrt(sum.cosine * sum.cosine + sum.sine * sum.sine + 0.04f);
  return {sum.cosine * inverse, sum.sine * inverse};
}

}  // namespace globe::planet
