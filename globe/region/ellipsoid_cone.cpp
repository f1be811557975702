#include "globe/region/ellipsoid_cone.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "globe/base/error.h"
#include "globe/geo/geodesic_circle.h"

namespace globe::region {
namespace {

using geo::Ellipsoid;
using geo::Geodetic;
using htm::dvec3;
using htm::Relation;

constexpr double kBorder = 5e-15;    ///< of the equatorial radius; what `contains` takes in beyond
constexpr double kMargin = 1.5e-14;  ///< radians; more than that and the errors of geodesics and series

class Circle final : public htm::Curve {
 public:
  Circle(const Ellipsoid& ellipsoid, const Geodetic& center, double radius_m)
      : circle_(ellipsoid, center, radius_m) {}

  dvec3 at(double t) const override { return circle_.at(2.0 * std::numbers::pi * t); }
  double bend(double, double) const override {
    return 4.0 * std::numbers::pi * std::numbers::pi * circle_.bend();
  }

 private:
  geo::GeodesicCircle circle_;
};

double angle(const dvec3& a, const dvec3& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * glm::distance(a, b)));
}

double longest_distance_m(const Ellipsoid& ellipsoid) {
  return geo::geodesic_distance_m(ellipsoid, {90.0, 0.0, 0.0}, {-90.0, 0.0, 0.0});
}

htm::Border border(const Ellipsoid& ellipsoid, const Geodetic& center, double radius_m,
                   bool circle_is_border) {
  std::vector<std::shared_ptr<const htm::Curve>> curves;
  if (circle_is_border) curves.push_back(std::make_shared<Circle>(ellipsoid, center, radius_m));
  return {std::move(curves), kMargin};
}

}  // namespace

EllipsoidCone::EllipsoidCone(const Ellipsoid& ellipsoid, const Geodetic& center, double radius_m)
    : ellipsoid_(ellipsoid),
      center_(center),
      center_normal_(geo::normal_from_degrees(center.lat_deg, center.lon_deg)),
      radius_m_(radius_m),
      everything_(radius_m >= longest_distance_m(ellipsoid)),
      circle_is_border_(radius_m < 0.999999 * geo::injectivity_radius_m(ellipsoid)),
      border_(border(ellipsoid, center, radius_m, circle_is_border_)) {
  if (!(radius_m >= 0.0)) {
    throw UsageError("cone", "a radius of " + std::to_string(radius_m) + " m is not a distance",
                     "give 0 or more");
  }
  // Radii of curvature are between these two.
  const double a = ellipsoid.a, b = ellipsoid.b();
  shortest_scale_m_ = std::min(b * (b / a), a * (a / b));
  longest_scale_m_ = std::max(b * (b / a), a * (a / b));
}

double EllipsoidCone::distance_m(const dvec3& u) const {
  return geo::geodesic_distance_m(ellipsoid_, center_, geo::degrees_from_normal(u));
}

bool EllipsoidCone::contains(const dvec3& u) const {
  constexpr double kSafe = 1e-9;
  const double theta = angle(center_normal_, u);
  if (everything_ || theta * longest_scale_m_ < radius_m_ * (1.0 - kSafe)) return true;
  if (theta * shortest_scale_m_ > radius_m_ * (1.0 + kSafe) + kSafe * ellipsoid_.a) return false;
  return distance_m(u) <= radius_m_ + kBorder * ellipsoid_.a;
}

Relation EllipsoidCone::relation(const htm::Corners& t) const {
  if (everything_) return Relation::kInside;
  if (circle_is_border_) {
    if (border_.touches(t)) return Relation::kTouches;
    return contains(t[0]) ? Relation::kInside : Relation::kDisjoint;
  }
  const dvec3 middle = glm::normalize(t[0] + t[1] + t[2]);
  const double size_m = longest_scale_m_ *
                        (std::max({angle(middle, t[0]), angle(middle, t[1]), angle(middle, t[2])}) + kMargin);
  const double middle_m = distance_m(middle);
  if (middle_m + size_m <= radius_m_) return Relation::kInside;
  return middle_m - size_m > radius_m_ ? Relation::kDisjoint : Relation::kTouches;
}

std::vector<dvec3> EllipsoidCone::border_points() const {
  if (everything_) return {};
  // Along a meridian if the ellipsoid is flat, else toward the east at right angles: the geodesics that stay
  // the shortest for longest.
  return {geo::geodesic_end(ellipsoid_, center_, ellipsoid_.f >= 0.0 ? 0.0 : 90.0, radius_m_)};
}

}  // namespace globe::region
