#include "globe/planet/craters.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace globe::planet {
namespace {

constexpr float kEjectaReach = 1.9f;  ///< ejecta end here, in crater radii
constexpr float kLargest =
    0.5f;  ///< crater radius in cells: kEjectaReach times it stays inside the neighbouring cells
constexpr float kSmallest = 0.15f;
constexpr float kShell = 0.5f;  ///< centres as far off the sphere, in cells, have faded out
constexpr float kDepth = 0.4f;  ///< in radii
constexpr float kRim = 0.08f;

/// Height and its derivative by distance, both in radii; x: distance from the centre in radii.
struct Profile {
  float height, slope;
};

GLOBE_INLINE Profile profile(float x) {
  const float out = kEjectaReach - x;
  const float bowl = (kDepth + kRim) * x * x - kDepth;
  const float bowl_slope = 2.0f * (kDepth + kRim) * x;
  const float scale = kRim / ((kEjectaReach - 1.0f) * (kEjectaReach - 1.0f));
  const float ejecta = scale * out * out;
  const float ejecta_slope = -2.0f * scale * out;
  // The lower of the two, with the corner at the rim rounded.
  constexpr float kRound = 0.08f;
  const float t = lesser(1.0f, greater(0.0f, 0.5f + 0.5f * (ejecta - bowl) / kRound));
  return {bowl * t + ejecta * (1.0f - t) - kRound * t * (1.0f - t),
          bowl_slope * t + ejecta_slope * (1.0f - t)};
}

constexpr float kParts = 255.0f;  ///< places and sizes are bytes of a hash: lengths are in 255ths of a cell

/// Places in the cells of one octave.
struct OctaveLanes {
  LaneFloats up_x, up_y, up_z;
  LaneFloats x, y, z;  ///< inside the cell, in parts
  std::array<std::uint32_t, kLanes> hash_x, hash_y, hash_z;
};

GLOBE_FOR_EVERY_VECTOR_WIDTH void enter_octave(double cells_per_radius, const LanePlaces& u,
                                               OctaveLanes& __restrict o) {
  using namespace lattice;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const dvec3 p{u.x[k] * cells_per_radius, u.y[k] * cells_per_radius, u.z[k] * cells_per_radius};
    const dvec3 cell{floor_of(p.x), floor_of(p.y), floor_of(p.z)};
    o.up_x[k] = static_cast<float>(u.x[k]);
    o.up_y[k] = static_cast<float>(u.y[k]);
    o.up_z[k] = static_cast<float>(u.z[k]);
    o.x[k] = kParts * static_cast<float>(p.x - cell.x);
    o.y[k] = kParts * static_cast<float>(p.y - cell.y);
    o.z[k] = kParts * static_cast<float>(p.z - cell.z);
    o.hash_x[k] = scaled(static_cast<int>(cell.x), kX);
    o.hash_y[k] = scaled(static_cast<int>(cell.y), kY);
    o.hash_z[k] = scaled(static_cast<int>(cell.z), kZ);
  }
}

template <int kShift>
GLOBE_INLINE float part(std::uint32_t hash) {
  return static_cast<float>(static_cast<int>((hash >> kShift) & 255u));
}

/// In cells.
GLOBE_INLINE float radius_of(std::uint32_t hash) {
  const float size = part<24>(hash) * (1.0f / kParts);
  return kSmallest + (kLargest - kSmallest) * size * size * size;
}

/// A cell beside the one a place is in.
struct Step {
  std::uint32_t hash_x, hash_y, hash_z;
  float x, y, z;
};

/// The crater of a cell as seen from a place: along the ground and off it, in parts.
struct Seen {
  float x, y, z, off;
};

GLOBE_INLINE std::uint32_t crater_hash(std::uint32_t seed, const OctaveLanes& o, std::size_t k,
                                       const Step& step) {
  return lattice::finish(seed ^ (o.hash_x[k] + step.hash_x) ^ (o.hash_y[k] + step.hash_y) ^
                         (o.hash_z[k] + step.hash_z));
}

GLOBE_INLINE Seen crater_away(const OctaveLanes& o, std::size_t k, const Step& step, std::uint32_t hash) {
  const float x = (o.x[k] - step.x) - part<0>(hash);
  const float y = (o.y[k] - step.y) - part<8>(hash);
  const float z = (o.z[k] - step.z) - part<16>(hash);
  return {x, y, z, x * o.up_x[k] + y * o.up_y[k] + z * o.up_z[k]};
}

GLOBE_INLINE void stamp(const OctaveLanes& o, std::size_t k, const Step& step, std::uint32_t hash,
                        float wave_m, ReliefLanes& r) {
  const Seen away = crater_away(o, k, step, hash);
  const float radius = radius_of(hash);
  const float flat_x = (away.x - o.up_x[k] * away.off) * (1.0f / kParts);
  const float flat_y = (away.y - o.up_y[k] * away.off) * (1.0f / kParts);
  const float flat_z = (away.z - o.up_z[k] * away.off) * (1.0f / kParts);
  const float distance = std::sqrt(flat_x * flat_x + flat_y * flat_y + flat_z * flat_z);
  const float off = away.off * (1.0f / (kShell * kParts));
  const float shell = greater(0.0f, 1.0f - off * off);
  const float age = 0.25f + 0.75f * unit_from_hash(hash * 0x9e3779b9u);
  const float fade = distance < kEjectaReach * radius ? shell * shell * age : 0.0f;
  const Profile at = profile(distance / radius);
  r.height_m[k] += fade * radius * wave_m * at.height;
  const float pull = fade * at.slope / greater(distance, 1e-12f);
  r.slope_x[k] += flat_x * pull;
  r.slope_y[k] += flat_y * pull;
  r.slope_z[k] += flat_z * pull;
  r.prominence[k] += fade * 3.0f * at.height;
}

constexpr std::array<Step, 27> make_steps() {
  std::array<Step, 27> steps{};
  std::size_t count = 0;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        using namespace lattice;
        steps[count++] = {static_cast<std::uint32_t>(dx) * kX, static_cast<std::uint32_t>(dy) * kY,
                          static_cast<std::uint32_t>(dz) * kZ, kParts * static_cast<float>(dx),
                          kParts * static_cast<float>(dy),     kParts * static_cast<float>(dz)};
      }
    }
  }
  return steps;
}
constexpr std::array<Step, 27> kSteps = make_steps();

/// The craters of the 27 cells around each place, those within reach of one of the places.
GLOBE_FOR_EVERY_VECTOR_WIDTH void stamp_octave(std::uint32_t seed, const OctaveLanes& o, float wave_m,
                                               ReliefLanes& __restrict r) {
  constexpr float kSlack = 1.001f;  // stamp decides; this test must only not miss any
  std::array<std::uint32_t, kLanes> hash;
  for (const Step& step : kSteps) {
    unsigned reached = 0;
    for (std::size_t k = 0; k < kLanes; ++k) {
      hash[k] = crater_hash(seed, o, k, step);
      const Seen away = crater_away(o, k, step, hash[k]);
      const float square = away.x * away.x + away.y * away.y + away.z * away.z;
      const float reach = kSlack * kEjectaReach * kParts * radius_of(hash[k]);
      const float off2 = away.off * away.off;
      reached |=
          (off2 < kShell * kShell * kParts * kParts ? 1u : 0u) & (square - off2 < reach * reach ? 1u : 0u);
    }
    if (reached == 0) continue;
    for (std::size_t k = 0; k < kLanes; ++k) stamp(o, k, step, hash[k], wave_m, r);
  }
}

}  // namespace

ReliefLanes crater_relief(const ReliefScale& scale, const ReliefPlaces& places) {
  ReliefLanes r;
  OctaveLanes octave;
  std::uint32_t seed = scale.seed + 0x80;
  for (double wave = 3.0 * scale.data_edge_m; wave >= scale.finest_wave_m; wave *= 0.5, ++seed) {
    enter_octave(scale.radius_m / wave, places.u, octave);
    stamp_octave(seed, octave, static_cast<float>(wave), r);
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float many = 0.45f + 0.55f * places.roughness[k];
    r.height_m[k] *= many;
    r.slope_x[k] *= many;
    r.slope_y[k] *= many;
    r.slope_z[k] *= many;
    r.prominence[k] = lesser(1.0f, greater(-1.0f, r.prominence[k]));
  }
  return r;
}

}  // namespace globe::planet
