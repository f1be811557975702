#include "globe/planet/craters.h"

#include <cmath>

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

GLOBE_INLINE Profile profile(float x) {
  const float out = kReach - x;
  const float bowl = (kDepth + kRim) * x * x - kDepth;
  const float bowl_slope = 2.0f * (kDepth + kRim) * x;
  const float scale = kRim / ((kReach - 1.0f) * (kReach - 1.0f));
  const float ejecta = scale * out * out;
  const float ejecta_slope = -2.0f * scale * out;
  // The lower of the two, with the corner at the rim rounded.
  constexpr float kRound = 0.08f;
  const float t = lesser(1.0f, greater(0.0f, 0.5f + 0.5f * (ejecta - bowl) / kRound));
  return {bowl * t + ejecta * (1.0f - t) - kRound * t * (1.0f - t),
          bowl_slope * t + ejecta_slope * (1.0f - t)};
}

/// Places in the cells of one octave, and the craters of one of the cells around each.
struct OctaveLanes {
  LaneFloats up_x, up_y, up_z;
  LaneFloats x, y, z;  ///< inside the cell
  std::array<std::uint32_t, kLanes> hash_x, hash_y, hash_z;
  // The crater: where it is seen along the ground, and 0 < fade where the place is within its reach.
  LaneFloats flat_x, flat_y, flat_z, distance, radius, fade;
};

GLOBE_FOR_EVERY_VECTOR_WIDTH void enter_octave(double cells_per_radius, const LanePlaces& u,
                                               OctaveLanes& __restrict o) {
  using namespace lattice;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const dvec3 p{u.x[k] * cells_per_radius, u.y[k] * cells_per_radius, u.z[k] * cells_per_radius};
    const int ix = floor_of(p.x), iy = floor_of(p.y), iz = floor_of(p.z);
    o.up_x[k] = static_cast<float>(u.x[k]);
    o.up_y[k] = static_cast<float>(u.y[k]);
    o.up_z[k] = static_cast<float>(u.z[k]);
    o.x[k] = static_cast<float>(p.x - static_cast<double>(ix));
    o.y[k] = static_cast<float>(p.y - static_cast<double>(iy));
    o.z[k] = static_cast<float>(p.z - static_cast<double>(iz));
    o.hash_x[k] = scaled(ix, kX);
    o.hash_y[k] = scaled(iy, kY);
    o.hash_z[k] = scaled(iz, kZ);
  }
}

template <int kShift>
GLOBE_INLINE float part(std::uint32_t hash) {
  return static_cast<float>(static_cast<int>((hash >> kShift) & 255u)) * (1.0f / 255.0f);
}

GLOBE_INLINE std::uint32_t stepped(std::uint32_t scaled_cell, std::uint32_t factor, int step) {
  return scaled_cell + lattice::scaled(step, factor);
}

/// Looks at the crater of the cell (dx, dy, dz) away; true if any place is within its reach.
GLOBE_FOR_EVERY_VECTOR_WIDTH bool find_craters(std::uint32_t seed, int dx, int dy, int dz,
                                               OctaveLanes& __restrict o) {
  using namespace lattice;
  unsigned reached = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const std::uint32_t hash = finish(seed ^ stepped(o.hash_x[k], kX, dx) ^ stepped(o.hash_y[k], kY, dy) ^
                                      stepped(o.hash_z[k], kZ, dz));
    const float away_x = o.x[k] - (static_cast<float>(dx) + part<0>(hash));
    const float away_y = o.y[k] - (static_cast<float>(dy) + part<8>(hash));
    const float away_z = o.z[k] - (static_cast<float>(dz) + part<16>(hash));
    const float off = away_x * o.up_x[k] + away_y * o.up_y[k] + away_z * o.up_z[k];
    const float size = part<24>(hash);
    const float radius = kSmallest + (kLargest - kSmallest) * size * size * size;
    const float flat_x = away_x - o.up_x[k] * off;
    const float flat_y = away_y - o.up_y[k] * off;
    const float flat_z = away_z - o.up_z[k] * off;
    const float distance = std::sqrt(flat_x * flat_x + flat_y * flat_y + flat_z * flat_z);
    const float shell = greater(0.0f, 1.0f - off * off * (1.0f / (kShell * kShell)));
    const float age = 0.25f + 0.75f * unit_from_hash(hash * 0x9e3779b9u);
    const float fade = distance < kReach * radius ? shell * shell * age : 0.0f;
    o.flat_x[k] = flat_x;
    o.flat_y[k] = flat_y;
    o.flat_z[k] = flat_z;
    o.distance[k] = distance;
    o.radius[k] = radius;
    o.fade[k] = fade;
  }
  for (std::size_t k = 0; k < kLanes; ++k) reached |= o.fade[k] > 0.0f ? 1u : 0u;
  return reached != 0;
}

GLOBE_FOR_EVERY_VECTOR_WIDTH void stamp(const OctaveLanes& o, float wave_m, ReliefLanes& __restrict r) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Profile at = profile(o.distance[k] / o.radius[k]);
    const float fade = o.fade[k];
    r.height_m[k] += fade * o.radius[k] * wave_m * at.height;
    const float pull = fade * at.slope / greater(o.distance[k], 1e-12f);
    r.slope_x[k] += o.flat_x[k] * pull;
    r.slope_y[k] += o.flat_y[k] * pull;
    r.slope_z[k] += o.flat_z[k] * pull;
    r.prominence[k] += fade * 3.0f * at.height;
  }
}

}  // namespace

ReliefLanes crater_relief(const ReliefScale& scale, const ReliefPlaces& places) {
  ReliefLanes r;
  OctaveLanes octave;
  std::uint32_t seed = scale.seed + 0x80;
  for (double wave = 3.0 * scale.data_edge_m; wave >= scale.finest_wave_m; wave *= 0.5, ++seed) {
    enter_octave(scale.radius_m / wave, places.u, octave);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (find_craters(seed, dx, dy, dz, octave)) stamp(octave, static_cast<float>(wave), r);
        }
      }
    }
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
