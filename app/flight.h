#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/optics.h"
#include "globe/clipmap/settings.h"
#include "globe/planet/surface.h"
#include "globe/scene/scene.h"

namespace app {

/// An end of a flight.
struct FlightEnd {
  globe::geo::Geodetic place;
  double above_ground_m = 0;
};

/// A camera's flight above the ground, clear of the ground all the way: between two places, or along the path
/// of a scene.
///
/// Heights of its ends, or of the places of a path, count from the ground under them, in between from the
/// ground's height interpolated along. Where mountains stand in the way the flight is raised: by a smooth
/// rise that begins and ends a twelfth of its time away from them, so far that it keeps a quarter of its own
/// height above them. A path's places themselves are raised only where such ground is within a quarter of
/// that time. Nothing of it reaches over a jump. Nowhere is it nearer to the ground than least_clearance.
class Flight {
 public:
  /// @param max_level  finest level of triangles
  /// @param look       at its end
  Flight(const globe::clipmap::Settings& settings, std::shared_ptr<const globe::planet::Surface> surface,
         int max_level, const FlightEnd& from, const FlightEnd& to, const Look& look);

  /// Throws globe::Error when all places of the path are one.
  Flight(const globe::clipmap::Settings& settings, std::shared_ptr<const globe::planet::Surface> surface,
         int max_level, const globe::scene::Path& path);

  struct View {
    globe::geo::Geodetic place;
    Look look;
  };

  /// @param t     share of the flight's time, [0, 1]
  /// @param wait  false: the ground at hand, so that it takes no time
  View at(double t, bool wait) const;

  /// What a path takes; 0 for a flight between two places, which is as long as its film.
  double duration_s() const { return duration_s_; }

 private:
  /// What it would do were there no ground in its way.
  struct Planned {
    View view;
    double above_m = 0;  ///< over the interpolated ground
  };
  struct Rise {
    double t, width;  ///< of the flight's time
    double metres;
  };

  double ground_below(globe::geo::Geodetic place) const;
  void find_rises(const std::vector<double>& marks);
  void find_rises_of_leg(std::span<const double> marks, int least_samples);
  double raised_by(double t) const;

  globe::clipmap::Settings settings_;
  std::shared_ptr<const globe::planet::Surface> surface_;
  int max_level_;
  std::function<Planned(double t)> plan_;
  double duration_s_ = 0;
  std::vector<Rise> rises_;
};

/// The least height above ground of a camera that flies: 2 m, less on small bodies.
double least_clearance(const globe::geo::Ellipsoid& ellipsoid);

}  // namespace app
