#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "globe/geo/ellipsoid.h"
#include "globe/render/camera.h"

namespace globe::effects {

/// Meridians and parallels so many seconds of arc apart, and between them finer ones that are coming in.
struct GraticuleSteps {
  double step_arcsec = 0;   ///< divides a quarter of a turn
  double finer_arcsec = 0;  ///< divides `step`, or is it
  double finer_share = 0;   ///< of the finer lines, 0 to 1
};

/// Of a step that is asked for. REQUIRES: divides_quarter.
GraticuleSteps fixed_steps(double step_deg);
/// Whether a number of degrees divides 90.
bool divides_quarter(double step_deg);

/// By what a camera sees: about six lines across the ground in the lower half of its picture, from 30 degrees
/// to a hundredth of a second. Continuous in the camera's place and direction.
///
/// @param ground_m  height of the ground under the camera above the ellipsoid
GraticuleSteps steps_in_view(const geo::Ellipsoid& ellipsoid, const render::Camera& camera, double ground_m);

/// A latitude or longitude that lies on a line, as people write it: "45°N", "7°30′E", "0°", "12°06′04.5″W".
/// @param seconds  from the equator or Greenwich, north or east positive
/// @param step     what lines are apart, which says how many parts are written
std::string latitude_text(double seconds, double step_arcsec);
std::string longitude_text(double seconds, double step_arcsec);

}  // namespace globe::effects
