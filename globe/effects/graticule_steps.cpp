#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"
#include "globe/effects/graticule.h"

namespace globe::effects {
namespace {

constexpr double kLines = 6.0;  ///< across what is in view
constexpr double kQuarter_arcsec = 90.0 * 3600.0;

/// Each divides the one before.
constexpr std::array kSteps{30.0 * 3600, 10.0 * 3600, 5.0 * 3600, 3600.0, 30.0 * 60, 10.0 * 60,
                            5.0 * 60,    60.0,        30.0,       10.0,   5.0,       1.0,
                            0.5,         0.1,         0.05,       0.01};

/// From the camera to the ground, taken for the ellipsoid at one height, some way below the picture's middle.
double distance_to_ground(const geo::Ellipsoid& ellipsoid, const render::Camera& camera, double ground_m,
                          double above_m) {
  const double radius = ellipsoid.mean_radius();
  const double horizon = std::sqrt(above_m * (2.0 * radius + above_m));
  const double hit =
      geo::ray_ellipsoid(ellipsoid, ground_m, camera.position, render::direction_through(camera, 0.5, 0.7));
  return std::clamp(hit < 0.0 ? horizon : hit, above_m, std::max(horizon, above_m));
}

/// Whole degrees alone, or with minutes, or with seconds.
std::string angle_text(double seconds, double step_arcsec) {
  const double size = std::abs(seconds);
  char text[48];
  if (std::fmod(step_arcsec, 3600.0) == 0.0) {
    std::snprintf(text, sizeof text, "%.0f°", size / 3600.0);
    return text;
  }
  if (std::fmod(step_arcsec, 60.0) == 0.0) {
    const auto minutes = static_cast<long>(std::lround(size / 60.0));
    std::snprintf(text, sizeof text, "%ld°%02ld′", minutes / 60, minutes % 60);
    return text;
  }
  const int digits = step_arcsec >= 1.0 && std::fmod(step_arcsec, 1.0) == 0.0 ? 0
                     : step_arcsec >= 0.1                                     ? 1
                                                                              : 2;
  const double unit = std::pow(10.0, digits);
  const auto units = std::llround(size * unit), in_minute = std::llround(60.0 * unit);
  const long long minutes = units / in_minute;
  std::snprintf(text, sizeof text, "%lld°%02lld′%0*.*f″", minutes / 60, minutes % 60,
                digits > 0 ? 3 + digits : 2, digits, static_cast<double>(units % in_minute) / unit);
  return text;
}

}  // namespace

bool divides_quarter(double step_deg) {
  const double lines = 90.0 / step_deg;
  return lines >= 1.0 && std::abs(lines - std::round(lines)) < 1e-6 * std::min(1.0, 1e-3 * lines + 1e-3);
}

GraticuleSteps fixed_steps(double step_deg) {
  // A whole number of lines in a quarter, exactly.
  const double step = kQuarter_arcsec / std::round(90.0 / step_deg);
  return {step, step, 0.0};
}

GraticuleSteps steps_in_view(const geo::Ellipsoid& ellipsoid, const render::Camera& camera, double ground_m) {
  const double radius = ellipsoid.mean_radius();
  const double above_m =
      std::max(geo::geodetic_from_ecef(ellipsoid, camera.position).h_m - ground_m, 1e-7 * radius);
  const double across = 2.0 * camera.tan_y() * distance_to_ground(ellipsoid, camera, ground_m, above_m);
  const double wanted = across / radius * kRadian * 3600.0 / kLines;
  if (wanted >= kSteps.front()) return {kSteps.front(), kSteps.front(), 0.0};
  for (std::size_t k = 1; k < kSteps.size(); ++k) {
    if (wanted < kSteps[k]) continue;
    const double gone = std::log(kSteps[k - 1] / wanted) / std::log(kSteps[k - 1] / kSteps[k]);
    const double t = std::clamp(2.0 * gone - 1.0, 0.0, 1.0);
    return {kSteps[k - 1], kSteps[k], t * t * (3.0 - 2.0 * t)};
  }
  return {kSteps.back(), kSteps.back(), 0.0};
}

std::string latitude_text(double seconds, double step_arcsec) {
  return angle_text(seconds, step_arcsec) + (seconds > 0.0 ? "N" : seconds < 0.0 ? "S" : "");
}

std::string longitude_text(double seconds, double step_arcsec) {
  const double folded = std::remainder(seconds, 4.0 * kQuarter_arcsec);
  const bool on_end = std::abs(folded) == 2.0 * kQuarter_arcsec;
  return angle_text(folded, step_arcsec) + (on_end || folded == 0.0 ? "" : folded > 0.0 ? "E" : "W");
}

}  // namespace globe::effects
