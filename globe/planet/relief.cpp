#include "globe/planet/relief.h"

#include "globe/planet/craters.h"
#include "globe/planet/valleys.h"

namespace globe::planet {
namespace {

struct ValleyLanes {
  LaneFloats say, shift;
};

GLOBE_INLINE Relief relief_of(const ReliefLanes& r, std::size_t k) {
  return {r.height_m[k], {r.slope_x[k], r.slope_y[k], r.slope_z[k]}, r.prominence[k]};
}

GLOBE_INLINE void store(const Relief& from, std::size_t k, ReliefLanes& __restrict r) {
  r.height_m[k] = from.height_m;
  r.slope_x[k] = from.slope.x;
  r.slope_y[k] = from.slope.y;
  r.slope_z[k] = from.slope.z;
  r.prominence[k] = from.prominence;
}

GLOBE_FOR_EVERY_VECTOR_WIDTH void raise_massifs(std::uint32_t seed, double cells_per_radius, float wave_m,
                                                const ReliefPlaces& places, LaneFloats& __restrict weight,
                                                ReliefLanes& __restrict r) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    Relief one = relief_of(r, k);
    raise_massif(seed, cells_per_radius, wave_m, places.u.get(k), places.roughness[k], one, weight[k]);
    store(one, k, r);
  }
}

GLOBE_FOR_EVERY_VECTOR_WIDTH void carve_octave(std::uint32_t seed, double cells_per_radius, float wave_m,
                                               float even, const ReliefPlaces& places,
                                               ValleyLanes& __restrict state, ReliefLanes& __restrict r) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    Relief one = relief_of(r, k);
    ValleyState own{state.say[k], state.shift[k]};
    carve_valley(seed, cells_per_radius, wave_m, even, places.u.get(k), places.roughness[k],
                 {places.base_x[k], places.base_y[k], places.base_z[k]}, one, own);
    state.say[k] = own.say;
    state.shift[k] = own.shift;
    store(one, k, r);
  }
}

GLOBE_FOR_EVERY_VECTOR_WIDTH void deepen_octave(float wave_m, float even, const ReliefPlaces& places,
                                                ReliefLanes& __restrict r) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    Relief one = relief_of(r, k);
    deepen_valley(wave_m, even, places.roughness[k], {places.base_x[k], places.base_y[k], places.base_z[k]},
                  one);
    store(one, k, r);
  }
}

bool all_hushed(const ValleyLanes& state) {
  float most = 0.0f;
  for (std::size_t k = 0; k < kLanes; ++k) most = greater(most, state.say[k]);
  return most < kValleyHush;
}

void carve_valleys(const ReliefScale& scale, const ReliefPlaces& places, ReliefLanes& __restrict r) {
  ValleyLanes state;
  for (std::size_t k = 0; k < kLanes; ++k) {
    state.say[k] = 1.0f;
    state.shift[k] = kValleyWinding * r.prominence[k];
  }
  std::uint32_t seed = scale.seed + 0x40;
  for (double wave = 0.5 * scale.data_edge_m; wave >= scale.finest_wave_m; wave *= 0.5, ++seed) {
    const auto wave_m = static_cast<float>(wave);
    if (!all_hushed(state)) {
      carve_octave(seed, scale.radius_m / wave, wave_m, evenness(wave), places, state, r);
      continue;
    }
    deepen_octave(wave_m, evenness(wave), places, r);
  }
}

}  // namespace

ReliefLanes massif_relief(const ReliefScale& scale, const ReliefPlaces& places) {
  ReliefLanes r;
  if (scale.craters) return r;
  LaneFloats weight;
  weight.fill(1.0f);
  double wave = 2.0 * scale.data_edge_m;
  for (std::uint32_t k = 0; k < 2 && wave >= scale.finest_wave_m; ++k, wave *= 0.5)
    raise_massifs(scale.seed + k, scale.radius_m / wave, static_cast<float>(wave), places, weight, r);
  return r;
}

ReliefLanes carved_relief(const ReliefScale& scale, const ReliefPlaces& places) {
  if (scale.craters) return crater_relief(scale, places);
  ReliefLanes r = massif_relief(scale, places);
  carve_valleys(scale, places, r);
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (places.roughness[k] <= 0.0f) store({0.0f, vec3(0.0f), 0.0f}, k, r);
  }
  return r;
}

}  // namespace globe::planet
