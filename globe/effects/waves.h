#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/geo/point.h"

namespace globe::effects {

/// A sinusoid of the sea's height.
struct Wave {
  double amplitude_m = 0;  ///< >= 0
  double wavelength_m = 1;
  double phase = 0;     ///< radians, where and when the reference place has time 0
  double from_deg = 0;  ///< bearing of where it comes from, at the reference place
};

/// Waves on deep water: angular frequency (radians a second) squared is gravity times wave number.
double angular_frequency(double wavelength_m);
/// Length of waves of so many a second.
double deep_water_length(double per_second);

/// Mean square of the slopes of a sea that a wind of m/s has raised, both directions together (Cox and Munk
/// 1954, "Measurement of the roughness of the sea surface from photographs of the sun's glitter").
double slope_variance(double wind_speed);
/// The part of it that waves have.
double slope_variance(const std::vector<Wave>& waves);

/// Waves that a wind of m/s has raised in the long run: the spectrum of Pierson and Moskowitz (1964), cut
/// into bands from its longest waves down to 0.1 m, with directions spread about the wind's as the cosine
/// squared. The same for the same wind, longest first; none in a calm.
std::vector<Wave> wind_waves(double wind_speed, double from_deg);

/// A sea of such waves around a globe.
///
/// Each runs from a point a quarter of the globe away from a reference place along its bearing there: its
/// phase is k R a - w t + phase, `a` being the angle from that point, so that its wavelength is the same
/// everywhere; less a constant, which makes `phase` that of the reference place at time 0. Angles are those
/// of round space, where the ellipsoid is a sphere of its mean radius: true lengths differ by up to 0.4 % on
/// the Earth.
class Sea {
 public:
  Sea(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& reference, std::vector<Wave> waves);

  /// Longest first.
  const std::vector<Wave>& waves() const { return waves_; }
  double amplitudes_m() const;  ///< their sum

  /// A wave where a place is the foot of the vertical of round space.
  struct Local {
    glm::dvec3 along;  ///< unit tangent, which way it runs
    double phase;      ///< [-pi, pi]
    double cotangent;  ///< of the angle from its source; bounded
  };
  /// @param foot  unit, round space
  Local at(std::size_t wave, const glm::dvec3& foot, double time_s) const;

  /// Height of the sum, metres, over deep water.
  double height_m(const glm::dvec3& foot, double time_s) const;

  /// Unit vector of round space toward a place in ECEF.
  glm::dvec3 foot(const glm::dvec3& ecef) const;
  double radius_m() const { return radius_m_; }

 private:
  double radius_m_;
  glm::dvec3 rounding_;
  std::vector<Wave> waves_;
  std::vector<glm::dvec3> sources_;
};

}  // namespace globe::effects
