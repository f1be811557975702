#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "globe/planet/relief.h"

/// Massifs and valleys at one place, one octave at a time: the body of a loop over lanes.
namespace globe::planet {

/// Of one place, as far as the octaves so far go.
struct Relief {
  float height_m;
  vec3 slope;
  float prominence;
};

GLOBE_INLINE float dot_of(const vec3& a, const vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// One octave of massifs. `weight` of the octave, set for the next; 1 for the first.
GLOBE_INLINE void raise_massif(std::uint32_t seed, double cells_per_radius, float wave_m, const dvec3& u,
                               float roughness, Relief& r, float& weight) {
  constexpr float kHeight = 0.055f;  // over the wavelength, where roughness is 1
  constexpr float kRounding = 0.03f;
  const NoiseSample n =
      gradient_noise(seed, {u.x * cells_per_radius, u.y * cells_per_radius, u.z * cells_per_radius});
  const float fold = std::sqrt(n.value * n.value + kRounding);  // |x|, rounded at 0
  const float height = kHeight * roughness * weight;
  const float crest = 1.0f - 2.2f * fold;
  r.height_m += height * wave_m * crest;
  const vec3 up{static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)};
  const float along_up = dot_of(n.gradient, up);
  const float factor = -2.2f * height * (n.value / fold);
  r.slope.x += (n.gradient.x - up.x * along_up) * factor;
  r.slope.y += (n.gradient.y - up.y * along_up) * factor;
  r.slope.z += (n.gradient.z - up.z * along_up) * factor;
  r.prominence = greater(-1.0f, lesser(1.0f, crest));
  weight = 0.5f + 0.5f * greater(0.0f, r.prominence);
}

/// What valleys of finer octaves need to know of the coarser ones.
struct ValleyState {
  float say;    ///< how much finer valleys may change: none along the crests and floors of coarser ones
  float shift;  ///< turns; valleys wind with the relief they cut
};

inline constexpr float kValleyWinding = 0.18f;  ///< turns
inline constexpr float kValleyHush = 0.02f;     ///< finer valleys with less say are left out
inline constexpr float kValleyDepth = 0.085f;   ///< half a valley's depth over the wavelength
inline constexpr float kFlat = 1e-6f;           ///< slope too small to have a direction

/// Share of the square root of roughness at a wavelength: small valleys are more alike everywhere than
/// massifs are.
inline float evenness(double wave_m) {
  return static_cast<float>(wave_m < 2500.0 ? 0.55 * (1.0 - wave_m / 2500.0) : 0.0);
}
GLOBE_INLINE float roughness_at(float roughness, float even) {
  return roughness + even * (std::sqrt(roughness) - roughness);
}

GLOBE_INLINE bool is_flat(const vec3& slope) { return dot_of(slope, slope) < kFlat * kFlat; }

/// One octave where finer valleys have no say: as deep as the coarser ones, no new ones.
GLOBE_INLINE void deepen_valley(float wave_m, float even, float roughness, const vec3& base, Relief& r) {
  const bool flat = is_flat({base.x + r.slope.x, base.y + r.slope.y, base.z + r.slope.z});
  const float depth = flat ? 0.0f : kValleyDepth * roughness_at(roughness, even);
  r.height_m += depth * wave_m * r.prominence;
}

/// One octave of valleys down `r.slope` and the base slope.
GLOBE_INLINE void carve_valley(std::uint32_t seed, double cells_per_radius, float wave_m, float even,
                               const dvec3& u, float roughness, const vec3& base, Relief& r,
                               ValleyState& state) {
  constexpr float kWavesPerCell = 1.0f;
  constexpr float kCrestRounding = 0.012f;  // squared; 0 would fold crests sharply
  constexpr float kSliding = 1.5f;
  constexpr float kTurn = 6.2831853f;
  const vec3 slope{base.x + r.slope.x, base.y + r.slope.y, base.z + r.slope.z};
  const vec3 up{static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)};
  const float steep2 = dot_of(slope, slope);
  const float inverse = 1.0f / std::sqrt(greater(steep2, kFlat * kFlat));
  const float rough = roughness_at(roughness, even);
  const float gentle = 0.10f * rough + 0.001f;
  const float gate = steep2 / (steep2 + gentle * gentle);
  const vec3 across{(up.y * slope.z - up.z * slope.y) * inverse, (up.z * slope.x - up.x * slope.z) * inverse,
                    (up.x * slope.y - up.y * slope.x) * inverse};
  const Stripes stripes =
      stripe_noise(seed, {u.x * cells_per_radius, u.y * cells_per_radius, u.z * cells_per_radius}, across,
                   kWavesPerCell, state.shift);
  // Phase 0 is a crest: 1 - 2 |sin(phase / 2)| is sharp there and round in the floor, at phase pi.
  const float half = std::sqrt(0.5f * (1.0f - stripes.cosine) + kCrestRounding);
  const float profile = 1.0f - 2.0f * half;
  const float profile_slope = -0.5f * stripes.sine / half;
  // What is steep already slides before it is carved deeper.
  const float allowed = greater(state.say - kValleyHush, 0.0f) * gate / (1.0f + kSliding * steep2);
  const bool flat = is_flat(slope);
  const float weight = flat ? 0.0f : allowed;
  const float depth = flat ? 0.0f : kValleyDepth * rough;
  const float value = r.prominence + weight * (profile - r.prominence);
  r.height_m += depth * wave_m * value;
  const float turn = depth * kTurn * weight * profile_slope;
  r.slope.x += turn * across.x;
  r.slope.y += turn * across.y;
  r.slope.z += turn * across.z;
  r.prominence = value;
  state.shift = kValleyWinding * stripes.sine;
  state.say *= lesser(1.0f, 1.6f * stripes.sine * stripes.sine + 0.12f);
}

}  // namespace globe::planet
