#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace globe::planet {

using glm::dvec3;
using glm::vec3;

/// Relief finer than the data as a function of place: massifs, and on their slopes valleys in valleys.
///
/// Massifs are ridges of noise, 2 and 1 data cells apart. Valleys are stripes that run down the slope of
/// everything coarser, each octave on the slopes the one before has made, so that they branch; stripes are
/// sharp along their crests and round in their floors. After Rune Skovbo Johansen's erosion filter (2023).
struct ReliefScale {
  std::uint32_t seed = 1;
  double radius_m = 1;
  double data_edge_m = 1;    ///< distance between data nodes
  double finest_wave_m = 1;  ///< carved to this wavelength
  bool craters = false;      ///< carve craters (craters.h) instead; no massifs
};

struct ReliefSample {
  float height_m = 0;
  vec3 slope{0.0f};      ///< tangent vector, rise over run
  float prominence = 0;  ///< [-1, 1]: valley floor to crest, of the finest octave that has a say
};

/// The massifs alone. `u`: geodetic normal; `roughness` [0, 1].
ReliefSample massif_relief(const ReliefScale& scale, const dvec3& u, float roughness);

/// Massifs and what is carved into them. `base_slope`: of the ground without its relief.
ReliefSample carved_relief(const ReliefScale& scale, const dvec3& u, float roughness, const vec3& base_slope);

}  // namespace globe::planet
