#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "app/view_options.h"
#include "flat/terrain.h"
#include "globe/geo/ellipsoid.h"

namespace app {

/// Where a camera stands and looks.
struct FlatView {
  globe::geo::Geodetic place;
  Look look;
};

/// A view of a whole region: from above its southern side to its middle.
FlatView overview(const globe::flat::Terrain& terrain);

/// A flight in a straight line over a region, easing in and out. Heights above ground go from that of its
/// beginning to that of its end; where ground stands in the way the flight is raised, smoothly, so that it
/// keeps a quarter of its height above ground and at least 2 m.
class FlatFlight {
 public:
  FlatFlight(const globe::flat::Terrain& terrain, const FlatView& from, const FlatView& to);

  /// @param t  share of the flight, [0, 1]
  FlatView at(double t) const;

 private:
  const globe::flat::Terrain& terrain_;
  FlatView from_, to_;
  glm::dvec3 begin_, end_;
  std::vector<double> raised_m_;  ///< at even shares
};

}  // namespace app
