#pragma once

#include <vector>

#include "globe/scene/monotone_cubic.h"
#include "globe/scene/path_key.h"
#include "globe/scene/sphere_curve.h"

namespace globe::scene {

/// A camera's way past the stops of a path, smooth in velocity: a function of time alone, whatever the
/// frames.
///
/// The place follows a SphereCurve; the height above ground is a MonotoneCubic in its logarithm over that of
/// the ground's height at the stops, so that between two stops it is between theirs. Headings turn the short
/// way round, measured from a direction on the sphere that the path keeps away from: from north, unless it
/// comes within 5 degrees of a pole. A stop without a look looks along the way, down from high above
/// (pitch_for_height). A jump ends one such way and begins another.
class CameraPath {
 public:
  /// @param low_pitch_deg  pitch of stops without a look, low down
  /// REQUIRES: what stops_of returns
  CameraPath(const std::vector<PathStop>& stops, double low_pitch_deg);

  double duration_s() const { return times_.back(); }
  /// Of the stops, from 0 on; where the camera jumps, twice the same.
  const std::vector<double>& times() const { return times_; }

  struct View {
    glm::dvec3 u{0, 0, 1};  ///< geodetic normal
    double ground_m = 0;    ///< interpolated between the stops
    double above_m = 1;     ///< above that
    double heading_deg = 0;
    double pitch_deg = 0;
    double roll_deg = 0;
  };
  /// The first or last view outside the path's time; at a jump the one after it.
  View at(double time_s) const;

 private:
  /// The way from jump to jump.
  struct Leg {
    Leg(const std::vector<PathStop>& stops, double lowest_m, double low_pitch_deg);

    double begin_s;
    SphereCurve place;
    MonotoneCubic ground, log_above;
    glm::dvec3 reference;  ///< headings are kept from the direction toward it
    MonotoneCubic heading, pitch, roll;
  };

  std::vector<double> times_;
  std::vector<Leg> legs_;
};

}  // namespace globe::scene
