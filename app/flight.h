#pragma once

#include <memory>
#include <vector>

#include "globe/clipmap/settings.h"
#include "globe/planet/surface.h"
#include "globe/scene/flight_path.h"

namespace app {

/// An end of a flight.
struct FlightEnd {
  globe::geo::Geodetic place;
  double above_ground_m = 0;
};

/// A camera's flight between two places above the ground, clear of the ground all the way.
///
/// Heights of its ends count from the ground under them, in between from the ground's height interpolated
/// along. Where mountains stand in the way the flight is raised: by a smooth rise that begins and ends a
/// twelfth of its time away from them, so far that it keeps a quarter of its own height above them. Nowhere
/// is it nearer to the ground than least_clearance.
class Flight {
 public:
  /// @param max_level  finest level of triangles
  Flight(const globe::clipmap::Settings& settings, std::shared_ptr<const globe::planet::Surface> surface,
         int max_level, const FlightEnd& from, const FlightEnd& to, double heading_deg, double pitch_deg);

  struct View {
    globe::geo::Geodetic place;
    double heading_deg = 0;
    double pitch_deg = 0;
  };

  /// @param t     share of the flight's time, [0, 1]
  /// @param wait  false: the ground at hand, so that it takes no time
  View at(double t, bool wait) const;

 private:
  struct Rise {
    double t, width;  ///< of the flight's time
    double metres;
  };

  globe::geo::Geodetic planned(double t, globe::scene::PathPoint& point) const;
  double ground_below(globe::geo::Geodetic place) const;
  void find_rises();
  double raised_by(double t) const;

  globe::clipmap::Settings settings_;
  std::shared_ptr<const globe::planet::Surface> surface_;
  int max_level_;
  globe::scene::FlightPath path_;
  double from_ground_, to_ground_;
  std::vector<Rise> rises_;
};

/// The least height above ground of a camera that flies: 2 m, less on small bodies.
double least_clearance(const globe::geo::Ellipsoid& ellipsoid);

}  // namespace app
