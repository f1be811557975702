#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "converters/map_geometry.h"
#include "globe/planet/grid.h"

namespace converters {

/// The part of a map that a node stands for: the cell whose corners are the centres of the trixels around it,
/// made symmetric about the node, with sides straight in the map.
///
/// Symmetric, because the lattice has a kink along every edge of a coarser trixel: the plain cells tile the
/// planet exactly, but their middles lie up to a quarter of a cell beside their nodes, and the ground would
/// move with them (seen 0.0046 on cos(lat) cos(lon) at level 6, against 0.0006). The price is that along
/// those edges neighbours overlap or leave out a little: the mean of the planet is kept to 1e-3, not exactly.
/// The two pole nodes have caps.
struct Footprint {
  struct Corner {
    double x;  ///< columns from the node's own SamplePlace::x.whole
    double y;
  };
  std::array<Corner, 6> corner;
  int count = 0;  ///< 0: none, of a node whose surroundings are not all on the map

  double min_x() const;
  double max_x() const;
  double min_y() const;
  double max_y() const;
};

/// How far from a node its footprint may reach, radians.
double footprint_reach(int level);

/// Footprint of a node that is not a pole. Depends on the vertex alone, not on the diamond that names it.
Footprint footprint_of(const MapGeometry& geometry, const globe::planet::Node& node);

/// Footprint from the place of the node and those of the centres of its trixels, in order around it; of no
/// corners when one of them is not on the map.
Footprint make_footprint(const MapGeometry& geometry, const SamplePlace& node,
                         const std::array<SamplePlace, 6>& centres, int count);

/// Direction of the middle of a trixel, of unit length where the map needs that.
inline globe::planet::dvec3 trixel_centre(const MapGeometry& geometry, const globe::planet::dvec3& a,
                                          const globe::planet::dvec3& b, const globe::planet::dvec3& c) {
  const globe::planet::dvec3 sum = a + b + c;
  return geometry.takes_any_length() ? sum : glm::normalize(sum);
}

/// The row coordinate where the cap of a pole's node ends.
double cap_rim(const MapGeometry& geometry, int level, bool north);

}  // namespace converters
