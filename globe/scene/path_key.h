#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace globe::scene {

/// Heading clockwise from north and pitch above the horizon, degrees.
struct Look {
  double heading_deg = 0;
  double pitch_deg = 0;
};

/// A place of a camera's path as its author gave it, in a scene or in a file of tracks.
struct PathKey {
  int line = 0;  ///< of the file
  std::optional<double> time_s;
  geo::Geodetic place;        ///< h_m: above the ellipsoid, or above the ground
  bool above_ground = false;  ///< h_m counts from the ground
  std::optional<Look> look;   ///< none: along the way
  /// > 0: the place is what the camera looks at, from so far away, and the look is told there. REQUIRES:
  /// look.
  double range_m = 0;
  bool stop = false;    ///< the camera comes to rest here
  double roll_deg = 0;  ///< clockwise, seen from behind the camera: the right side goes down
  /// The camera is here all at once, and until then where the key before has it. Its time may be that key's.
  bool jump = false;
};

/// Throws Error, naming file and line, unless the keys make a path: two or more, at places one can be at, all
/// with times or none, and the times increasing, but for jumps.
void require_path(const std::vector<PathKey>& keys, const std::string& file);

/// A place of a path on a planet.
struct PathStop {
  double time_s = 0;
  glm::dvec3 u{0, 0, 1};  ///< geodetic normal
  double ground_m = 0;    ///< height of the ground there above the ellipsoid
  double above_m = 1;     ///< height above that ground, > 0
  std::optional<Look> look;
  bool stop = false;
  double roll_deg = 0;
  bool jump = false;  ///< at the time of the stop before
};

/// Puts a path on a planet. Keys without times are passed at a constant speed over the ground, within
/// kUntimed seconds; keys at one place one after the other are then one.
///
/// @param ground_m  height of the ground above the ellipsoid
/// @param least_m   a camera is nowhere lower above the ground, > 0
/// REQUIRES: what require_path requires. Throws Error when nothing but one place is left.
std::vector<PathStop> stops_of(const std::vector<PathKey>& keys, const geo::Ellipsoid& ellipsoid,
                               const std::function<double(const geo::Geodetic&)>& ground_m, double least_m);
inline constexpr double kUntimed = 60.0;

}  // namespace globe::scene
