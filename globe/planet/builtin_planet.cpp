#include "globe/planet/builtin_planet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "globe/planet/grid.h"
#include "globe/planet/noise.h"

namespace globe::planet {
namespace {

constexpr float kSeaShare = 0.62f;
constexpr double kHighest = 5600.0;  ///< detail below 20 km adds up to some 2000 m to either side
constexpr double kDeepest = -7000.0;

/// A seed for each field, apart by more than the octaves it uses.
enum Field : std::uint32_t {
  kWarpX = 0x100,
  kWarpY = 0x200,
  kWarpZ = 0x300,
  kContinents = 0x400,
  kChains = 0x500,
  kActivity = 0x600,
  kCrests = 0x700,
  kHills = 0x800,
  kSeaFloor = 0x900,
  kRain = 0xa00,
};

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

BuiltinPlanet::BuiltinPlanet(std::uint64_t seed)
    : seed_(static_cast<std::uint32_t>(vertex_hash(seed, {0, 0, 0}) >> 32)) {
  constexpr int kLevel = 5;
  std::vector<float> values;
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j = 0; j < nodes_per_side(kLevel); ++j)
      for (int i = 0; i < nodes_per_side(kLevel); ++i)
        values.push_back(continent_at(node_direction({d, kLevel, i, j})).inland);
  }
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(kSeaShare * static_cast<float>(values.size()));
  std::nth_element(values.begin(), nth, values.end());
  coast_ = *nth;
}

BuiltinPlanet::Continent BuiltinPlanet::continent_at(const dvec3& u) const {
  const dvec3 warp{fractal_noise(seed_ + kWarpX, u * 1.9, 4, 0.5f),
                   fractal_noise(seed_ + kWarpY, u * 1.9, 4, 0.5f),
                   fractal_noise(seed_ + kWarpZ, u * 1.9, 4, 0.5f)};
  const dvec3 warped = u + 0.28 * warp;
  return {warped, fractal_noise(seed_ + kContinents, warped * 1.25, 8, 0.5f) / 0.55f - coast_};
}

double BuiltinPlanet::mountains_at(const dvec3& u, const Continent& continent) const {
  const float field = fractal_noise(seed_ + kChains, continent.warped * 1.05, 4, 0.42f);
  const float belt = std::max(0.0f, 1.0f - std::abs(field) / 0.17f);
  if (belt == 0.0f) return 0.0;
  const float active = smooth_step(-0.25f, 0.3f, fractal_noise(seed_ + kActivity, u * 1.8, 2, 0.5f));
  const float land = smooth_step(-0.16f, 0.1f, continent.inland);
  const float crest = ridged_noise(seed_ + kCrests, continent.warped * 11.0, 5, 0.6f);
  const float rise = belt * std::sqrt(belt) * active;
  const float on_land = 500.0f + 9500.0f * crest * std::sqrt(crest);
  const float at_sea = 9500.0f * crest * crest;
  return rise * (land * on_land + (1.0f - land) * at_sea);
}

BuiltinPlanet::Point BuiltinPlanet::at(const dvec3& u) const {
  const Continent continent = continent_at(u);
  const float inland = continent.inland;
  const double mountains = mountains_at(u, continent);
  double height = 0.0;
  if (inland >= 0.0f) {
    const float hills = fractal_noise(seed_ + kHills, u * 12.0, 5, 0.5f);
    const float plateau = smooth_step(0.55f, 1.1f, inland + 0.3f * hills);
    height =
        380.0 * inland + 1300.0 * plateau + 220.0 * std::min(1.0f, 1.5f * inland) * std::max(-0.5f, hills);
  } else {
    const float floor = fractal_noise(seed_ + kSeaFloor, u * 9.0, 5, 0.5f);
    height = 900.0 * inland - 3700.0 * smooth_step(0.1f, 0.5f, -inland) +
             500.0 * smooth_step(0.2f, 0.6f, -inland) * floor;
  }
  const auto sine = static_cast<float>(std::abs(u.z));
  const float horse_latitudes = 1.0f - smooth_step(0.0f, 0.3f, std::abs(sine - 0.42f));
  const float rain = 0.8f - 0.62f * horse_latitudes - 0.2f * smooth_step(0.1f, 0.9f, inland) +
                     0.5f * fractal_noise(seed_ + kRain, continent.warped * 2.5, 4, 0.5f) +
                     0.15f * static_cast<float>(std::min(1.0, mountains / 2500.0));
  return {std::clamp(height + mountains, kDeepest, kHighest), std::clamp(rain, 0.0f, 1.0f)};
}

}  // namespace globe::planet
