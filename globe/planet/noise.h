#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace globe::planet {

using glm::dvec3;
using glm::vec3;

/// Noise in space, made of integer hashes, sums and products only: the same bits on every machine.

/// A well-mixed 32-bit hash of a lattice point.
std::uint32_t lattice_hash(std::uint32_t seed, int x, int y, int z);

/// Uniform in [0, 1) from a hash.
inline float unit_from_hash(std::uint32_t hash) { return static_cast<float>(hash >> 8) * 0x1p-24f; }

struct NoiseSample {
  float value;    ///< about [-1, 1], root mean square 0.4
  vec3 gradient;  ///< of value by p
};

/// Gradient noise with continuous second derivatives; one cell is one unit of p.
/// Source: Perlin 2002, "Improving noise"; derivatives as in Quilez, "Gradient noise derivatives".
NoiseSample gradient_noise(std::uint32_t seed, const dvec3& p);

/// Octaves of gradient noise, frequencies 1, 2, 4, ..., amplitudes 1, gain, gain², ...
float fractal_noise(std::uint32_t seed, const dvec3& p, int octaves, float gain);

/// Octaves of 1 - |noise|, each weighted by the one before: crests carry more crests, valleys stay smooth.
/// About [0, 1]. Source: Musgrave's ridged multifractal, "Texturing and Modeling", chapter 16.
float ridged_noise(std::uint32_t seed, const dvec3& p, int octaves, float gain);

/// sin(2 pi turns), within 0.0011, for turns up to a million; continuous in slope.
inline float sine_of_turns(float turns) {
  constexpr float kToInteger = 12582912.0f;  // 1.5 * 2^23: adding it leaves no bits for a fraction
  const float x = turns - ((turns + kToInteger) - kToInteger);
  const float y = 8.0f * x - 16.0f * x * std::abs(x);
  return y + 0.225f * (y * std::abs(y) - y);
}

struct Stripes {
  float cosine;  ///< 1 on a stripe's crest, -1 between two
  float sine;    ///< its rate of change along `across`, per radian of phase, is -sine
};

/// Stripes whose normal is `across` (unit), `waves` to a cell; their phase is random in each cell and blended
/// between cells, so that stripes fork and end. `across` and
/// `shift` (turns) may vary slowly from place to place.
/// Source: the stripe noise of Rune Skovbo Johansen's erosion filter (2023), here in space.
Stripes stripe_noise(std::uint32_t seed, const dvec3& p, const vec3& across, float waves, float shift);

}  // namespace globe::planet
