#pragma once

#include "app/standing_camera.h"
#include "globe/geo/ellipsoid.h"
#include "globe/scene/flight_path.h"

namespace app::view {

/// A flight of a few seconds from one standpoint to another that a person asked for: along a great circle, up
/// and down as far as it takes (globe/scene/flight_path.h), turning evenly.
class Glide {
 public:
  /// @param from_above_m, to_above_m  heights above ground there
  Glide(const globe::geo::Ellipsoid& ellipsoid, const Standpoint& from, double from_above_m,
        const Standpoint& to, double to_above_m);

  double duration_s() const { return duration_s_; }
  /// Where it is after so many seconds: at its end for good.
  Standpoint at(double seconds) const;

 private:
  globe::scene::FlightPath path_;
  Standpoint from_, to_;
  double from_ground_m_, to_ground_m_;
  glm::dvec3 begin_, end_;         ///< normals
  double from_turn_, turned_deg_;  ///< heading from the way ahead, and by how much that changes
  bool has_track_;
  double duration_s_;
};

}  // namespace app::view
