#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "app/view_options.h"
#include "flat/terrain.h"
#include "globe/geo/ellipsoid.h"
#include "globe/scene/flight_path.h"

namespace app {

/// Where a camera stands and looks.
struct FlatView {
  globe::geo::Geodetic place;
  Look look;
};

/// A view of a whole region: from above its southern side to its middle.
FlatView overview(const globe::flat::Terrain& terrain);

/// A flight over a region, as globe fly has it over a planet (scene::FlightPath): heights above ground go
/// from that of its beginning to that of its end and in between so high as the way is far, looking down from
/// there. Where ground stands in the way the flight is raised, smoothly, so that it keeps a quarter of its
/// height above ground; it is nowhere nearer to it than 2 m.
class FlatFlight {
 public:
  FlatFlight(const globe::flat::Terrain& terrain, const FlatView& from, const FlatView& to);

  /// @param t  share of the flight, [0, 1]
  FlatView at(double t) const;

 private:
  /// What it would do were there no ground in its way.
  struct Planned {
    glm::dvec3 at;       ///< in the frame
    double above_m = 0;  ///< over the ground interpolated from end to end
    double pitch_deg = 0;
  };
  Planned planned(double t) const;

  const globe::flat::Terrain& terrain_;
  FlatView from_, to_;
  double from_above_m_, to_above_m_, from_ground_m_, to_ground_m_;
  globe::scene::FlightPath path_;
  std::vector<double> raised_m_;  ///< at even shares
};

}  // namespace app
