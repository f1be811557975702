#pragma once

#include <cstdint>

#include "globe/clipmap/nadir.h"
#include "globe/clipmap/settings.h"

namespace globe::clipmap {

/// Where a level turns into the next coarser one: distances from the continuous nadir in 1/1024 cells of the
/// level.
///
/// α is 0 up to s/2 + 4m/3 and 1 from s - 4m/3 on: the hole's rim is never morphed and the region's rim
/// always is, wherever the nadir lies around the snapped centre (DESIGN section 5; the test repeats the
/// model's check).
struct MorphBand {
  std::int32_t begin;
  std::int32_t end;
};

inline MorphBand morph_band(const Settings& settings) {
  constexpr std::int32_t kNowhere = 1 << 30;
  if (!settings.morph) return {kNowhere, kNowhere + 1};
  const auto third = static_cast<std::int32_t>(4 * settings.m * kSubcell / 3);
  return {static_cast<std::int32_t>(settings.s * kSubcell / 2) + third,
          static_cast<std::int32_t>(settings.s * kSubcell) - third};
}

/// Morph factor at a distance: 0 fine, 1 coarse. The same formula as in shaders/clipmap.vert, in the same
/// precision.
inline float morph_factor(const MorphBand& band, std::int64_t distance) {
  const float t = static_cast<float>(distance - band.begin) / static_cast<float>(band.end - band.begin);
  return t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
}

/// How many levels a camera needs, as a real number: level l is wanted from the height at which its hexagon
/// spans `reach` times the height above ground.
///
/// @param root_edge  length of a level-0 edge, metres
/// @param height_m   height above the drawn ground, metres, > 0
/// @returns continuous level λ: levels up to floor(λ) are drawn; the finest is fading in while frac(λ) < 1/2
double wanted_level(const Settings& settings, double root_edge, double height_m);

/// The finest level drawn and how far it is still morphed into the one below (1: wholly coarse). A function
/// of height alone, so that a flight shows no pop and the same frame twice is the same.
struct FinestLevel {
  int level;
  float fade;
};
FinestLevel finest_level(const Settings& settings, double root_edge, double height_m, int max_level);

}  // namespace globe::clipmap
