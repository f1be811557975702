#pragma once

#include <glm/vec3.hpp>

#include "globe/geo/ellipsoid.h"

namespace globe::scene {

/// Where a camera on a path is and which way it looks.
struct PathPoint {
  glm::dvec3 u{0, 0, 1};  ///< geodetic normal of the place
  double height_m = 0;    ///< in the unit of the path's ends: above the ground or the ellipsoid
  double heading_deg = 0;
  double pitch_deg = 0;
};

/// A camera path between two places and heights, seven orders of magnitude apart or none, in one smooth
/// motion.
///
/// Height and ground distance follow van Wijk and Nuij 2003, "Smooth and efficient zooming and panning" (ρ
/// = 1.4): the picture moves and grows at a constant perceived speed; with no ground distance the height
/// changes exponentially. r = -asinh(b) instead of their log(sqrt(b² + 1) - b), which is -infinity at 1e7
/// : 1. Progress is eased at both ends (continuous acceleration). The ground track is the great circle of
/// normals; between antipodes it leads over the north pole, from pole to pole along the meridian of 0.
class FlightPath {
 public:
  /// @param from, to    normals, unit length
  /// @param from_height, to_height  metres, > 0
  /// @param radius      metres of ground to a radian of normals
  /// @param heading_deg, pitch_deg  the view at the end; high up the camera looks straight down instead
  FlightPath(const glm::dvec3& from, double from_height, const glm::dvec3& to, double to_height,
             double radius, double heading_deg, double pitch_deg);

  /// Point at t in [0, 1] of the path's time.
  PathPoint at(double t) const;

  /// Eased progress of time: 0 to 1, log-speed constant between 15 % and 85 % of the time.
  static double eased(double t);

 private:
  glm::dvec3 from_, toward_;  ///< toward_: unit, perpendicular to from_, along the track
  double from_height_, to_height_;
  double angle_;  ///< of the track, radians
  double radius_;
  double heading_deg_, pitch_deg_;
  double r0_ = 0, length_ = 0;
  bool zoom_only_ = true;
};

/// A unit vector perpendicular to `from`, toward `to`, both unit; between antipodes or at one place toward
/// north, at a pole along the meridian of 0.
glm::dvec3 track_direction(const glm::dvec3& from, const glm::dvec3& to);

/// Pitch for a height: the final one low down, straight down from high above, eased in the logarithm of
/// height.
double pitch_for_height(double height_m, double final_height_m, double final_pitch_deg);

}  // namespace globe::scene
