#include "globe/planet/craters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/planet/noise.h"

namespace globe::planet {
namespace {

constexpr float kReach = 1.9f;  ///< ejecta end here, in crater radii
constexpr float kLargest =
    0.5f;  ///< crater radius in cells: kReach times it stays inside the neighbouring cells
constexpr float kSmallest = 0.15f;
constexpr float kShell = 0.5f;  ///< centres as far off the sphere, in cells, have faded out
constexpr float kDepth = 0.4f;  ///< in radii
constexpr float kRim = 0.08f;

/// Height and its derivative by distance, both in radii; x: distance from the centre in radii.
struct Profile {
  float height, slope;
};

Profile profile(float x) {
  const float out = kReach - x;
  const float bowl = (kDepth + kRim) * x * x - kDepth;
  const float bowl_slope = 2.0f * (kDepth + kRim) * x;
  const float scale = kRim / ((kReach - 1.0f) * (kReach - 1.0f));
  const float ejecta = scale * out * out;
  const float ejecta_slope = -2.0f * scale * out;
  // The lower of the two, with the corner at the rim rounded.
  constexpr float kRound = 0.08f;
  const float t = std::clamp(0.5f + 0.5f * (ejecta - bowl) / kRound, 0.0f, 1.0f);
  return {bowl * t + ejecta * (1.0f - t) - kRound * t * (1.0f - t),
          bowl_slope * t + ejecta_slope * (1.0f - t)};
}

/// One octave: `p` in cells.
void stamp(std::uint32_t seed, const dvec3& p, const vec3& up, float wave_m, ReliefSample& r) {
  const dvec3 corner = glm::floor(p);
  const vec3 inside(p - corner);
  const int ix = static_cast<int>(corner.x), iy = static_cast<int>(corner.y), iz = static_cast<int>(corner.z);
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint32_t hash = lattice_hash(seed, ix + dx, iy + dy, iz + dz);
        const auto part = [hash](int shift) {
          return static_cast<float>((hash >> shift) & 255u) * (1.0f / 255.0f);
        };
        const vec3 away = inside - vec3(static_cast<float>(dx) + part(0), static_cast<float>(dy) + part(8),
                                        static_cast<float>(dz) + part(16));
        const float off = glm::dot(away, up) / kShell;
        if (off * off >= 1.0f) continue;
        const float size = part(24);
        const float radius = kSmallest + (kLargest - kSmallest) * size * size * size;
        const vec3 flat = away - up * (off * kShell);
        const float distance = glm::length(flat);
        if (distance >= kReach * radius) continue;
        const float age = 0.25f + 0.75f * unit_from_hash(hash * 0x9e3779b9u);
        const float fade = (1.0f - off * off) * (1.0f - off * off) * age;
        const Profile at = profile(distance / radius);
        r.height_m += fade * radius * wave_m * at.height;
        if (distance > 0.0f) r.slope += flat * (fade * at.slope / distance);
        r.prominence += fade * 3.0f * at.height;
      }
    }
  }
}

}  // namespace

ReliefSample crater_relief(const ReliefScale& scale, const dvec3& u, float roughness) {
  ReliefSample r;
  const vec3 up(u);
  std::uint32_t seed = scale.seed + 0x80;
  for (double wave = 3.0 * scale.data_edge_m; wave >= scale.finest_wave_m; wave *= 0.5, ++seed)
    stamp(seed, u * (scale.radius_m / wave), up, static_cast<float>(wave), r);
  const float many = 0.45f + 0.55f * roughness;
  return {many * r.height_m, many * r.slope, std::clamp(r.prominence, -1.0f, 1.0f)};
}

}  // namespace globe::planet
