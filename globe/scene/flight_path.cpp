#include "globe/scene/flight_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace globe::scene {
namespace {

constexpr double kRho = 1.4;    ///< trade of zooming against panning; van Wijk and Nuij's users liked 1.42
constexpr double kEase = 0.15;  ///< share of the time spent accelerating, and braking
constexpr double kTiltBegins = 250;  ///< times the final height: higher up the camera looks straight down

/// Integral of smoothstep from 0 to x, x in [0, 1].
double smoothstep_integral(double x) { return x * x * x - 0.5 * x * x * x * x; }

}  // namespace

glm::dvec3 track_direction(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 across = to - from * glm::dot(from, to);
  if (glm::length(across) > 1e-12) return glm::normalize(across);
  const glm::dvec3 north = glm::dvec3(0, 0, 1) - from * from.z;
  return glm::length(north) > 1e-12 ? glm::normalize(north) : glm::dvec3(1, 0, 0);
}

double FlightPath::eased(double t) {
  // Speed: smoothstep up over kEase, constant, smoothstep down; scaled to cover 1.
  const double area = 1.0 - kEase;
  t = std::clamp(t, 0.0, 1.0);
  if (t < kEase) return kEase * smoothstep_integral(t / kEase) / area;
  if (t > 1.0 - kEase) return 1.0 - kEase * smoothstep_integral((1.0 - t) / kEase) / area;
  return (t - 0.5 * kEase) / area;
}

double pitch_for_height(double height_m, double final_height_m, double final_pitch_deg) {
  const double x = std::clamp(std::log(height_m / final_height_m) / std::log(kTiltBegins), 0.0, 1.0);
  const double t = x * x * x * (x * (6.0 * x - 15.0) + 10.0);
  return final_pitch_deg + (-90.0 - final_pitch_deg) * t;
}

FlightPath::FlightPath(const glm::dvec3& from, double from_height, const glm::dvec3& to, double to_height,
                       double radius, double heading_deg, double pitch_deg)
    : from_(from),
      toward_(track_direction(from, to)),
      from_height_(from_height),
      to_height_(to_height),
      angle_(std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to))),
      radius_(radius),
      heading_deg_(heading_deg),
      pitch_deg_(pitch_deg) {
  const double ground = angle_ * radius_;
  zoom_only_ = ground < 1e-6 * std::min(from_height, to_height);
  if (zoom_only_) {
    length_ = std::abs(std::log(to_height / from_height)) / kRho;
    return;
  }
  const double rho2 = kRho * kRho;
  const double w0 = from_height, w1 = to_height;
  const double difference = (w1 - w0) * (w1 + w0);
  const double b0 = (difference + rho2 * rho2 * ground * ground) / (2.0 * w0 * rho2 * ground);
  const double b1 = (difference - rho2 * rho2 * ground * ground) / (2.0 * w1 * rho2 * ground);
  r0_ = -std::asinh(b0);
  length_ = (-std::asinh(b1) - r0_) / kRho;
}

PathPoint FlightPath::at(double t) const {
  const double e = eased(t);
  PathPoint point;
  double angle = 0;
  if (zoom_only_) {
    point.height_m = from_height_ * std::pow(to_height_ / from_height_, e);
    angle = angle_ * e;
  } else {
    const double s = length_ * e * kRho;
    point.height_m = from_height_ * std::cosh(r0_) / std::cosh(s + r0_);
    // cosh(r0) tanh(s + r0) - sinh(r0) = sinh(s) / cosh(s + r0): no cancellation at small s.
    angle = from_height_ / (kRho * kRho) * std::sinh(s) / std::cosh(s + r0_) / radius_;
  }
  if (t >= 1.0) {
    angle = angle_;
    point.height_m = to_height_;
  }
  point.u = glm::normalize(from_ * std::cos(angle) + toward_ * std::sin(angle));
  point.heading_deg = heading_deg_;
  point.pitch_deg = pitch_for_height(point.height_m, std::min(to_height_, from_height_), pitch_deg_);
  return point;
}

}  // namespace globe::scene
