#include "globe/planet/builtin_planet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "globe/planet/grid.h"

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
  static_assert((std::size_t{1} << kLevel) % kLanes == 0);
  std::vector<float> values;
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j = 0; j < nodes_per_side(kLevel); ++j) {
      for (int i = 0; i < nodes_per_side(kLevel); i += static_cast<int>(kLanes)) {
        LanePlaces u;
        for (std::size_t k = 0; k < kLanes; ++k)
          u.set(k, node_direction({d, kLevel, i + static_cast<int>(k), j}));
        const LaneFloats inland = continent_at(u).inland;
        values.insert(values.end(), inland.begin(), inland.end());
      }
    }
  }
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(kSeaShare * static_cast<float>(values.size()));
  std::nth_element(values.begin(), nth, values.end());
  coast_ = *nth;
}

BuiltinPlanet::Continent BuiltinPlanet::continent_at(const LanePlaces& u) const {
  const LaneFloats warp_x = fractal_noise(seed_ + kWarpX, u, 1.9, 4, 0.5f);
  const LaneFloats warp_y = fractal_noise(seed_ + kWarpY, u, 1.9, 4, 0.5f);
  const LaneFloats warp_z = fractal_noise(seed_ + kWarpZ, u, 1.9, 4, 0.5f);
  Continent continent;
  for (std::size_t k = 0; k < kLanes; ++k)
    continent.warped.set(k, u.get(k) + 0.28 * dvec3(warp_x[k], warp_y[k], warp_z[k]));
  continent.inland = fractal_noise(seed_ + kContinents, continent.warped, 1.25, 8, 0.5f);
  for (float& inland : continent.inland) inland = inland / 0.55f - coast_;
  return continent;
}

LaneFloats BuiltinPlanet::mountains_at(const LanePlaces& u, const Continent& continent) const {
  LaneFloats belt = fractal_noise(seed_ + kChains, continent.warped, 1.05, 4, 0.42f);
  for (float& b : belt) b = std::max(0.0f, 1.0f - std::abs(b) / 0.17f);
  if (std::all_of(belt.begin(), belt.end(), [](float b) { return b == 0.0f; })) return {};
  const LaneFloats activity = fractal_noise(seed_ + kActivity, u, 1.8, 2, 0.5f);
  const LaneFloats crests = ridged_noise(seed_ + kCrests, continent.warped, 11.0, 5, 0.6f);
  LaneFloats mountains;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float active = smooth_step(-0.25f, 0.3f, activity[k]);
    const float land = smooth_step(-0.16f, 0.1f, continent.inland[k]);
    const float crest = crests[k];
    const float rise = belt[k] * std::sqrt(belt[k]) * active;
    const float on_land = 500.0f + 9500.0f * crest * std::sqrt(crest);
    const float at_sea = 9500.0f * crest * crest;
    mountains[k] = rise * (land * on_land + (1.0f - land) * at_sea);
  }
  return mountains;
}

BuiltinPlanet::Points BuiltinPlanet::points_at(const LanePlaces& u) const {
  const Continent continent = continent_at(u);
  const LaneFloats& inland = continent.inland;
  const LaneFloats mountains = mountains_at(u, continent);
  const auto [lowest, highest] = std::minmax_element(inland.begin(), inland.end());
  const LaneFloats hills = *highest >= 0.0f ? fractal_noise(seed_ + kHills, u, 12.0, 5, 0.5f) : LaneFloats{};
  const LaneFloats floor = *lowest < -0.2f ? fractal_noise(seed_ + kSeaFloor, u, 9.0, 5, 0.5f) : LaneFloats{};
  const LaneFloats rains = fractal_noise(seed_ + kRain, continent.warped, 2.5, 4, 0.5f);
  Points points;
  for (std::size_t k = 0; k < kLanes; ++k) {
    double height = 0.0;
    if (inland[k] >= 0.0f) {
      const float plateau = smooth_step(0.55f, 1.1f, inland[k] + 0.3f * hills[k]);
      height = 380.0 * inland[k] + 1300.0 * plateau +
               220.0 * std::min(1.0f, 1.5f * inland[k]) * std::max(-0.5f, hills[k]);
    } else {
      height = 900.0 * inland[k] - 3700.0 * smooth_step(0.1f, 0.5f, -inland[k]) +
               500.0 * smooth_step(0.2f, 0.6f, -inland[k]) * floor[k];
    }
    const auto sine = static_cast<float>(std::abs(u.z[k]));
    const float horse_latitudes = 1.0f - smooth_step(0.0f, 0.3f, std::abs(sine - 0.42f));
    const float rain = 0.8f - 0.62f * horse_latitudes - 0.2f * smooth_step(0.1f, 0.9f, inland[k]) +
                       0.5f * rains[k] + 0.15f * std::min(1.0f, mountains[k] / 2500.0f);
    points[k] = {std::clamp(height + static_cast<double>(mountains[k]), kDeepest, kHighest),
                 std::clamp(rain, 0.0f, 1.0f)};
  }
  return points;
}

BuiltinPlanet::Point BuiltinPlanet::at(const dvec3& u) const { return at(std::span(&u, 1))[0]; }

std::vector<BuiltinPlanet::Point> BuiltinPlanet::at(std::span<const dvec3> u) const {
  std::vector<Point> result;
  result.reserve(u.size());
  for (std::size_t first = 0; first < u.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, u.size() - first);
    LanePlaces places;
    for (std::size_t k = 0; k < kLanes; ++k) places.set(k, u[first + std::min(k, count - 1)]);
    const Points points = points_at(places);
    result.insert(result.end(), points.begin(), points.begin() + count);
  }
  return result;
}

}  // namespace globe::planet
