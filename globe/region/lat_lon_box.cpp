#include "globe/region/lat_lon_box.h"

#include <cmath>
#include <string>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"
#include "globe/region/map_line.h"

namespace globe::region {
namespace {

constexpr const char* kHowToWrite = "give W,S,E,N in degrees such as 5.9,45.8,10.5,47.8";

/// From west eastward to east, 0 to 360 degrees.
double width(double west_deg, double east_deg) {
  if (east_deg - west_deg >= kTurn) return kTurn;
  double result = std::fmod(east_deg - west_deg, kTurn);
  if (result < 0.0) result += kTurn;
  return result;
}

void check(double west_deg, double south_deg, double east_deg, double north_deg) {
  if (!std::isfinite(west_deg) || !std::isfinite(south_deg) || !std::isfinite(east_deg) ||
      !std::isfinite(north_deg))
    throw UsageError("box", "its sides are not finite numbers", kHowToWrite);
  if (std::abs(south_deg) > 90.0 || std::abs(north_deg) > 90.0)
    throw UsageError("box", "a latitude is beyond 90 degrees", kHowToWrite);
  if (south_deg > north_deg) throw UsageError("box", "its south is north of its north", kHowToWrite);
}

htm::Border border(double west_deg, double south_deg, double width_deg, double north_deg) {
  std::vector<std::shared_ptr<const htm::Curve>> lines;
  const double east_deg = west_deg + width_deg;
  const auto add = [&](const MapPoint& from, const MapPoint& to) {
    lines.push_back(std::make_shared<MapLine>(from, to));
  };
  // A pole is no border: the meridians end there, and without them it lies inside.
  for (const double lat : {south_deg, north_deg})
    if (std::abs(lat) < 90.0) add({lat, west_deg}, {lat, east_deg});
  if (width_deg < kTurn)
    for (const double lon : {west_deg, east_deg}) add({south_deg, lon}, {north_deg, lon});
  return {std::move(lines), kMapBorderMargin};
}

}  // namespace

LatLonBox::LatLonBox(double west_deg, double south_deg, double east_deg, double north_deg)
    : west_deg_(west_deg),
      south_deg_(south_deg),
      width_deg_((check(west_deg, south_deg, east_deg, north_deg), width(west_deg, east_deg))),
      north_deg_(north_deg),
      border_(border(west_deg, south_deg, width_deg_, north_deg)) {}

bool LatLonBox::contains(const htm::dvec3& u) const {
  const geo::Geodetic at = geo::degrees_from_normal(u);
  if (at.lat_deg < south_deg_ - kMapBorderDeg || at.lat_deg > north_deg_ + kMapBorderDeg) return false;
  const double r = std::hypot(u.x, u.y);  // cosine of the latitude: a degree of longitude shrinks by it
  double east_of_west = std::fmod(at.lon_deg - west_deg_, kTurn);
  if (east_of_west < 0.0) east_of_west += kTurn;
  const double beyond = std::min(east_of_west - width_deg_, kTurn - east_of_west);
  return width_deg_ >= kTurn || beyond * r <= kMapBorderDeg;
}

htm::Relation LatLonBox::relation(const htm::Corners& trixel) const {
  if (border_.touches(trixel)) return htm::Relation::kTouches;
  return contains(trixel[0]) ? htm::Relation::kInside : htm::Relation::kDisjoint;
}

std::vector<htm::dvec3> LatLonBox::border_points() const {
  std::vector<htm::dvec3> points;
  for (const double lat : {south_deg_, north_deg_}) {
    // Without meridians a pole is no border.
    if (width_deg_ < kTurn || std::abs(lat) < 90.0)
      points.push_back(geo::normal_from_degrees(lat, west_deg_));
  }
  return points;
}

}  // namespace globe::region
