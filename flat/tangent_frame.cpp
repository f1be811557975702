#include "flat/tangent_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <cmath>

namespace globe::flat {
namespace {

geo::Geodetic folded(double lat_deg, double lon_deg) {
  const double turned = std::remainder(lon_deg, 360.0);
  return {lat_deg, turned >= 180.0 ? turned - 360.0 : turned, 0.0};
}

}  // namespace

TangentFrame::TangentFrame(const geo::Ellipsoid& ellipsoid, double lat_deg, double lon_deg)
    : ellipsoid_(ellipsoid),
      origin_(folded(lat_deg, lon_deg)),
      cartesian_(lat_deg, lon_deg, 0.0, GeographicLib::Geocentric(ellipsoid.a, ellipsoid.f)),
      center_(geo::ecef_from_geodetic(ellipsoid, origin_)) {
  const geo::LocalFrame frame = geo::local_frame(origin_.lat_deg, origin_.lon_deg);
  axes_ = {frame.east, frame.north, frame.up};
}

geo::Geodetic TangentFrame::geodetic_from_local(const dvec3& local) const {
  geo::Geodetic place;
  cartesian_.Reverse(local.x, local.y, local.z, place.lat_deg, place.lon_deg, place.h_m);
  if (place.lon_deg >= 180.0) place.lon_deg -= 360.0;
  return place;
}

dvec3 TangentFrame::local_from_geodetic(const geo::Geodetic& place) const {
  dvec3 local;
  cartesian_.Forward(place.lat_deg, place.lon_deg, place.h_m, local.x, local.y, local.z);
  return local;
}

double TangentFrame::z_at(double x_m, double y_m, double h_m) const {
  double z = h_m - (x_m * x_m + y_m * y_m) / (2.0 * ellipsoid_.mean_radius());
  for (int k = 0; k < 40; ++k) {
    double lat = 0, lon = 0, height = 0;
    cartesian_.Reverse(x_m, y_m, z, lat, lon, height);
    const double missing = h_m - height;
    z += missing;  // along the local vertical, where the frame's is wanted: a factor of cos(tilt) is left
    if (std::abs(missing) < 1e-3 * 1e-3) break;
  }
  return z;
}

dvec3 TangentFrame::normal_at(double x_m, double y_m, double h_m) const {
  const geo::Geodetic place = geodetic_from_local({x_m, y_m, z_at(x_m, y_m, h_m)});
  return geo::normal_from_degrees(place.lat_deg, place.lon_deg);
}

}  // namespace globe::flat
