#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/accuracy/study.h"
#include "converters/harmonics.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"
#include "globe/planet/surface.h"

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

/// Pairs of places kApart_m from each other, both on land of a planet, where heights matter. h_m is the
/// ground's at the level.
std::vector<PlacePair> land_pairs(const globe::planet::Surface& surface, const Scope& scope, int level);
constexpr double kApart_m = 50e3;
constexpr double kEye_m = 30.0;  ///< above ground, of those who look from one to the other
/// The level whose ground counts as true for questions about it.
inline int question_level(const Scope& scope) { return scope.full ? 15 : 14; }

/// A line through a picture of kEdgeSide pixels a side: where a point's part along `normal`, pixels from the
/// middle, y up, is less than `offset`, something is drawn.
struct Edge {
  glm::dvec2 normal;
  double offset;
};
constexpr int kEdgeSide = 32;
/// Edges at any angle.
std::vector<Edge> sample_edges();

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
