#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "globe/planet/noise.h"

namespace globe::planet {

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

/// kLanes places, side by side.
struct ReliefPlaces {
  LanePlaces u;                             ///< geodetic normals
  LaneFloats roughness;                     ///< [0, 1]
  LaneFloats base_x{}, base_y{}, base_z{};  ///< slope of the ground without its relief, a tangent vector

  void set(std::size_t k, const dvec3& normal, float rough, const vec3& base_slope) {
    u.set(k, normal);
    roughness[k] = rough;
    base_x[k] = base_slope.x;
    base_y[k] = base_slope.y;
    base_z[k] = base_slope.z;
  }
};

struct ReliefLanes {
  LaneFloats height_m{};
  LaneFloats slope_x{}, slope_y{}, slope_z{};  ///< tangent vector, rise over run
  LaneFloats prominence{};  ///< [-1, 1]: valley floor to crest, of the finest octave that has a say
};

/// Works nodes (i, j) out kLanes at a time: `set(node, k, places)` says where, `make(places)` is one of the
/// functions below, `get(node, k, relief)` takes what comes.
template <typename Set, typename Make, typename Get>
void in_lanes(const std::vector<glm::ivec2>& nodes, const Set& set, const Make& make, const Get& get) {
  ReliefPlaces places;
  for (std::size_t first = 0; first < nodes.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, nodes.size() - first);
    for (std::size_t k = 0; k < kLanes; ++k) set(nodes[first + std::min(k, count - 1)], k, places);
    const ReliefLanes relief = make(places);
    for (std::size_t k = 0; k < count; ++k) get(nodes[first + k], k, relief);
  }
}

/// The massifs alone; base slopes are not used.
ReliefLanes massif_relief(const ReliefScale& scale, const ReliefPlaces& places);

/// Massifs and what is carved into them.
ReliefLanes carved_relief(const ReliefScale& scale, const ReliefPlaces& places);

}  // namespace globe::planet
