#include "globe/planet/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "globe/planet/craters.h"
#include "globe/planet/noise.h"

namespace globe::planet {
namespace {

constexpr float kMassifHeight = 0.055f;  ///< height of a massif over its wavelength, where roughness is 1
constexpr float kValleyDepth = 0.085f;   ///< half a valley's depth over the wavelength
constexpr float kWavesPerCell = 1.0f;
constexpr float kCrestRounding = 0.012f;  ///< squared; 0 would fold crests sharply
constexpr float kHush = 0.02f;            ///< finer valleys with less say are left out
constexpr float kWinding = 0.18f;         ///< turns
constexpr float kSliding = 1.5f;
constexpr float kTurn = 6.2831853f;

vec3 tangent(const vec3& v, const vec3& up) { return v - up * glm::dot(v, up); }

/// |x|, rounded at 0, and its derivative.
struct RoundedAbs {
  float value, slope;
};
RoundedAbs rounded_abs(float x, float rounding) {
  const float r = std::sqrt(x * x + rounding);
  return {r, x / r};
}

/// Roughness at a wavelength: small valleys are more alike everywhere than massifs are.
float roughness_at(float roughness, double wave_m) {
  const auto t = static_cast<float>(std::max(0.0, 0.55 * (1.0 - wave_m / 2500.0)));
  return roughness + t * (std::sqrt(roughness) - roughness);
}

void carve_valleys(const ReliefScale& scale, const dvec3& u, float roughness, vec3 slope, ReliefSample& r) {
  const vec3 up(u);
  float say = 1.0f;  // how much finer valleys may change: none along the crests and floors of coarser ones
  float shift = kWinding * r.prominence;  // valleys wind with the relief they cut
  std::uint32_t seed = scale.seed + 0x40;
  for (double wave = 0.5 * scale.data_edge_m; wave >= scale.finest_wave_m; wave *= 0.5, ++seed) {
    const float steepness = glm::length(slope);
    if (steepness < 1e-6f) break;
    const float rough = roughness_at(roughness, wave);
    if (say < kHush) {
      r.height_m += kValleyDepth * rough * static_cast<float>(wave) * r.prominence;
      continue;
    }
    const float gentle = 0.10f * rough + 0.001f;
    const float gate = steepness * steepness / (steepness * steepness + gentle * gentle);
    const vec3 across = glm::cross(up, slope) / steepness;
    const Stripes stripes =
        stripe_noise(seed, u * (scale.radius_m / (wave * kWavesPerCell)), across, kWavesPerCell, shift);
    // Phase 0 is a crest: 1 - 2 |sin(phase / 2)| is sharp there and round in the floor, at phase pi.
    const float half = std::sqrt(0.5f * (1.0f - stripes.cosine) + kCrestRounding);
    const float profile = 1.0f - 2.0f * half;
    const float profile_slope = -0.5f * stripes.sine / half;
    // What is steep already slides before it is carved deeper.
    const float weight = (say - kHush) * gate / (1.0f + kSliding * steepness * steepness);
    const float depth = kValleyDepth * rough;
    const float value = r.prominence + weight * (profile - r.prominence);
    r.height_m += depth * static_cast<float>(wave) * value;
    const vec3 turn = (depth * kTurn * weight * profile_slope) * across;
    r.slope += turn;
    slope += turn;
    r.prominence = value;
    shift = kWinding * stripes.sine;
    const float flank = std::min(1.0f, 1.6f * stripes.sine * stripes.sine + 0.12f);
    say *= flank;
  }
}

}  // namespace

ReliefSample massif_relief(const ReliefScale& scale, const dvec3& u, float roughness) {
  ReliefSample r;
  if (scale.craters) return r;
  const vec3 up(u);
  float weight = 1.0f;
  double wave = 2.0 * scale.data_edge_m;
  for (std::uint32_t k = 0; k < 2 && wave >= scale.finest_wave_m; ++k, wave *= 0.5) {
    const NoiseSample n = gradient_noise(scale.seed + k, u * (scale.radius_m / wave));
    const RoundedAbs fold = rounded_abs(n.value, 0.03f);
    const float height = kMassifHeight * roughness * weight;
    r.height_m += height * static_cast<float>(wave) * (1.0f - 2.2f * fold.value);
    r.slope += tangent(n.gradient, up) * (-2.2f * height * fold.slope);
    r.prominence = std::clamp(1.0f - 2.2f * fold.value, -1.0f, 1.0f);
    weight = 0.5f + 0.5f * std::max(0.0f, r.prominence);
  }
  return r;
}

ReliefSample carved_relief(const ReliefScale& scale, const dvec3& u, float roughness,
                           const vec3& base_slope) {
  if (scale.craters) return crater_relief(scale, u, roughness);
  if (roughness <= 0.0f) return {};
  ReliefSample r = massif_relief(scale, u, roughness);
  carve_valleys(scale, u, roughness, base_slope + r.slope, r);
  return r;
}

}  // namespace globe::planet
