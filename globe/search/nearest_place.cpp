#include "globe/search/nearest_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "globe/base/angles.h"

namespace globe::search {
namespace {

using geo::dvec3;

double angle(const dvec3& a, const dvec3& b) {
  return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

}  // namespace

/// A great circle from a: at x radians it is a cos x + along sin x.
struct NearestPlace::Arc {
  dvec3 a, along;
  double length;

  Arc(const dvec3& from, const dvec3& to)
      : a(from),
        along(glm::normalize(glm::cross(glm::cross(from + to, to - from), from))),
        length(angle(from, to)) {}

  dvec3 at(double x) const { return std::cos(x) * a + std::sin(x) * along; }
  dvec3 direction(double x) const { return std::cos(x) * along - std::sin(x) * a; }

  /// The angle to u of the nearest of its places between x0 and x1.
  double nearest_angle(const dvec3& u, double x0, double x1) const {
    const double turn = 2.0 * std::numbers::pi;
    double foot = std::atan2(glm::dot(u, along), glm::dot(u, a));
    if (foot < x0) foot += turn;
    if (foot <= x1) return angle(u, at(foot));
    return std::min(angle(u, at(x0)), angle(u, at(x1)));
  }
};

NearestPlace::NearestPlace(const GeographicLib::Geodesic& earth, const geo::Geodetic& from)
    : earth_(earth),
      ellipsoid_{earth.EquatorialRadius(), earth.Flattening()},
      from_(from),
      from_normal_(geo::normal_from_degrees(from.lat_deg, from.lon_deg)) {
  const double a = ellipsoid_.a, b = ellipsoid_.b();
  shortest_scale_m_ = std::min(b * (b / a), a * (a / b));  // the smallest radius of curvature
}

bool NearestPlace::may_be_nearer(double angle) const {
  constexpr double kRounding = 1e-15;
  return shortest_scale_m_ * (angle - kRounding) < best_.distance_m;
}

void NearestPlace::look_at_point(const geo::Geodetic& at, const dvec3& u) {
  if (!may_be_nearer(angle(from_normal_, u))) return;
  double distance_m = 0;
  earth_.Inverse(from_.lat_deg, from_.lon_deg, at.lat_deg, at.lon_deg, distance_m);
  if (distance_m < best_.distance_m) best_ = {at, distance_m};
}

void NearestPlace::look_at_edge(const dvec3& a, const dvec3& b) {
  constexpr double kPiece = 2.0 * kDegree;
  if (a == b) return;
  const Arc arc(a, b);
  const auto pieces = static_cast<int>(std::ceil(arc.length / kPiece));
  for (int k = 0; k < pieces; ++k) look_between(arc, arc.length * k / pieces, arc.length * (k + 1) / pieces);
}

double NearestPlace::slope(const Arc& arc, double x) const {
  const dvec3 u = arc.at(x), direction = arc.direction(x);
  const geo::Geodetic at = geo::degrees_from_normal(u);
  double distance_m = 0, azimuth_here = 0, azimuth_there = 0;
  earth_.Inverse(from_.lat_deg, from_.lon_deg, at.lat_deg, at.lon_deg, distance_m, azimuth_here,
                 azimuth_there);
  const geo::LocalFrame frame = geo::local_frame(at.lat_deg, at.lon_deg);
  // Radii of curvature along the meridian and across it.
  const double e2 = ellipsoid_.f * (2.0 - ellipsoid_.f);
  const double w2 = 1.0 - e2 * u.z * u.z;
  const double across = ellipsoid_.a / std::sqrt(w2), along = across * (1.0 - e2) / w2;
  return std::sin(azimuth_there * kDegree) * across * glm::dot(direction, frame.east) +
         std::cos(azimuth_there * kDegree) * along * glm::dot(direction, frame.north);
}

void NearestPlace::look_at(const Arc& arc, double x) {
  const dvec3 u = arc.at(x);
  look_at_point(geo::degrees_from_normal(u), u);
}

void NearestPlace::look_between(const Arc& arc, double x0, double x1) {
  constexpr double kRounding = 1e-15;
  if (!may_be_nearer(arc.nearest_angle(from_normal_, x0, x1))) return;
  double slope0 = slope(arc, x0), slope1 = slope(arc, x1);
  if (slope0 >= 0.0 || slope1 <= 0.0) return look_at(arc, slope0 >= 0.0 ? x0 : x1);
  // Illinois: false position that halves the slope kept for the second time.
  int kept = 0;
  constexpr int kMost = 100;
  for (int k = 0; k < kMost && x1 - x0 > kRounding; ++k) {
    const double x = std::clamp((x0 * slope1 - x1 * slope0) / (slope1 - slope0), x0, x1);
    const double s = slope(arc, x);
    if (s == 0.0) {
      x0 = x1 = x;
    } else if (s < 0.0) {
      if (x == x0) break;
      x0 = x;
      slope0 = s;
      if (kept == -1) slope1 *= 0.5;
      kept = -1;
    } else {
      if (x == x1) break;
      x1 = x;
      slope1 = s;
      if (kept == 1) slope0 *= 0.5;
      kept = 1;
    }
  }
  look_at(arc, x0);
  look_at(arc, x1);
}

}  // namespace globe::search
