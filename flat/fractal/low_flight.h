#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "flat/fractal/ground.h"
#include "globe/render/camera.h"

namespace globe::flat::fractal {

/// A flight in a straight line close over the ground, rising before mountains. The ground is looked at post
/// by post, in flights beyond 200,000 posts at so many places.
class LowFlight {
 public:
  struct Course {
    glm::dvec2 from_m{0.0};    ///< metres east and north
    double heading_deg = 30;   ///< clockwise from north
    double length_m = 24000;   ///< >= 0
    double clearance_m = 300;  ///< least height above the ground, > 0
  };
  LowFlight(const Ground& ground, const Course& course);

  /// The eye: posts east and north, metres up.
  /// @param t  share of the flight, [0, 1]
  glm::dvec3 at(double t) const;

 private:
  glm::dvec2 from_posts_, along_posts_;
  double clearance_m_;
  std::vector<double> floor_m_;  ///< the ground, raised and smoothed, at even shares
};

/// A camera over flat ground (x east, y north, z up).
render::Camera flat_camera(double heading_deg, double pitch_deg, double fov_y_deg, double aspect);

}  // namespace globe::flat::fractal
