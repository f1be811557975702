#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/accuracy/study.h"
#include "converters/harmonics.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"

namespace app::accuracy {

/// Over what errors are measured: the same on every run, the hard places among them. In a header of their
/// own so that a second method can go over the same places.

struct PlacePair {
  globe::geo::Geodetic a, b;
};

/// Pairs anywhere, within a kilometre, within 0.3 degrees of the opposite place, along the equator and
/// meridians: as many of each.
std::vector<PlacePair> geodesic_pairs(const Scope& scope);

/// Anywhere, and on what interpolation finds hard: poles, edges of diamonds, the equator's fold.
std::vector<globe::geo::Geodetic> height_places(const Scope& scope);

/// Middles of caps of kConeRadius_deg: anywhere, the first three on corners of the octahedron.
std::vector<globe::htm::dvec3> cone_centres(const Scope& scope);
constexpr double kConeRadius_deg = 1.0;

/// Heights that are known everywhere: harmonics to degree 64, 1000 m RMS.
converters::Harmonics known_relief();

/// A map of the known relief, and the one that a round trip through the nodes is compared with: of another
/// width, so that what lies between the samples counts.
struct MapSample {
  int width;
  int truth_width;
  int own_level;  ///< with as many cells around the equator as the map has pixels
};
MapSample map_sample(const Scope& scope);

}  // namespace app::accuracy
