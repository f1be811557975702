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
/// (pitch_for_height).
class CameraPath {
 public:
  /// @param low_pitch_deg  pitch of stops without a look, low down
  /// REQUIRES: what stops_of returns
  CameraPath(const std::vector<PathStop>& stops, double low_pitch_deg);

  double duration_s() const { return times_.back(); }
  /// Of the stops, from 0 on.
  const std::vector<double>& times() const { return times_; }

  struct View {
    glm::dvec3 u{0, 0, 1};  ///< geodetic normal
    double ground_m = 0;    ///< interpolated between the stops
    double above_m = 1;     ///< above that
    double heading_deg = 0;
    double pitch_deg = 0;
  };
  /// The first or last view outside the path's time.
  View at(double time_s) const;

 private:
  std::vector<double> times_;
  SphereCurve place_;
  MonotoneCubic ground_, log_above_;
  glm::dvec3 reference_;  ///< headings are kept from the direction toward it
  MonotoneCubic heading_, pitch_;
};

}  // namespace globe::scene
