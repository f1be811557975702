#include "globe/scene/sphere_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "globe/scene/flight_path.h"
#include "globe/scene/monotone_cubic.h"

namespace globe::scene {
namespace {

using glm::dvec3;

/// The tangent at `from` that leads to `to` in one unit of time.
dvec3 arc(const dvec3& from, const dvec3& to) {
  const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
  return track_direction(from, to) * angle;
}

/// Where a tangent leads in one unit of time.
dvec3 gone(const dvec3& from, const dvec3& tangent) {
  const double angle = glm::length(tangent);
  if (angle == 0.0) return from;
  return glm::normalize(from * std::cos(angle) + tangent * (std::sin(angle) / angle));
}

dvec3 between(const dvec3& from, const dvec3& to, double share) { return gone(from, arc(from, to) * share); }

dvec3 no_longer(const dvec3& v, double most) {
  const double length = glm::length(v);
  return length > most ? v * (most / length) : v;
}

}  // namespace

SphereCurve::SphereCurve(std::vector<double> times, std::vector<dvec3> places, const std::vector<bool>& stops)
    : times_(std::move(times)), places_(std::move(places)), velocity_(places_.size(), dvec3(0.0)) {
  const std::size_t n = places_.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (stops[k]) continue;
    const double before = k > 0 ? times_[k] - times_[k - 1] : 0.0;
    const double after = k + 1 < n ? times_[k + 1] - times_[k] : 0.0;
    const dvec3 came = k > 0 ? -arc(places_[k], places_[k - 1]) / before : dvec3(0.0);
    const dvec3 goes = k + 1 < n ? arc(places_[k], places_[k + 1]) / after : dvec3(0.0);
    if (k == 0 || k + 1 == n) {
      velocity_[k] = came + goes;
    } else {
      velocity_[k] = no_longer((came * after + goes * before) / (before + after),
                               2.0 * std::min(glm::length(came), glm::length(goes)));
    }
  }
}

dvec3 SphereCurve::at(double time) const {
  if (time <= times_.front()) return places_.front();
  if (time >= times_.back()) return places_.back();
  const std::size_t k = piece_at(times_, time);
  const double span = times_[k + 1] - times_[k];
  const double x = (time - times_[k]) / span;
  std::array<dvec3, 4> points{places_[k], gone(places_[k], velocity_[k] * (span / 3.0)),
                              gone(places_[k + 1], velocity_[k + 1] * (-span / 3.0)), places_[k + 1]};
  for (std::size_t left = 3; left > 0; --left) {
    for (std::size_t p = 0; p < left; ++p) points[p] = between(points[p], points[p + 1], x);
  }
  return points[0];
}

dvec3 SphereCurve::direction(std::size_t k) const {
  if (glm::length(velocity_[k]) > 0.0) return glm::normalize(velocity_[k]);
  // At rest: the way on, else the way here.
  for (std::size_t next = k + 1; next < places_.size(); ++next) {
    if (places_[next] != places_[k]) return track_direction(places_[k], places_[next]);
  }
  for (std::size_t last = k; last-- > 0;) {
    if (places_[last] != places_[k]) return -track_direction(places_[k], places_[last]);
  }
  return track_direction(places_[k], -places_[k]);
}

}  // namespace globe::scene
