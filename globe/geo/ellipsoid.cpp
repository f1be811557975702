#include "globe/geo/ellipsoid.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "globe/base/error.h"

namespace globe::geo {

Ellipsoid make_ellipsoid(double a, double f) {
  if (!(std::isfinite(a) && a > 0.0)) {
    throw UsageError("ellipsoid", "the radius " + std::to_string(a) + " is not a positive length",
                     "give A,F in metres, such as 6378137,1/298.257");
  }
  if (!(std::isfinite(f) && f < 1.0)) {
    throw UsageError("ellipsoid", "the flattening " + std::to_string(f) + " is not below 1",
                     "give A,F such as 6378137,1/298.257");
  }
  const Ellipsoid ellipsoid{a, f};
  if (!(std::isfinite(ellipsoid.b()) && ellipsoid.b() > 0.0)) {
    throw UsageError("ellipsoid",
                     "a polar radius of " + std::to_string(ellipsoid.b()) + " is not a positive length",
                     "give A,F in metres, such as 6378137,1/298.257");
  }
  return ellipsoid;
}

Geodetic degrees_from_normal(const dvec3& u) {
  const double r = std::hypot(u.x, u.y);
  double lon = r == 0.0 ? 0.0 : GeographicLib::Math::atan2d(u.y, u.x);
  if (lon >= 180.0) lon -= 360.0;
  return {GeographicLib::Math::atan2d(u.z, r), lon, 0.0};
}

dvec3 surface_point(const Ellipsoid& ellipsoid, const dvec3& u) {
  // The formula divided by a², with uz scaled by b/a first and divisions kept: exact on the axes.
  const double w = (1.0 - ellipsoid.f) * u.z;
  const double n = std::sqrt(u.x * u.x + u.y * u.y + w * w);
  return {ellipsoid.a * (u.x / n), ellipsoid.a * (u.y / n), ellipsoid.b() * (w / n)};
}

dvec3 ecef_from_normal(const Ellipsoid& ellipsoid, const dvec3& u, double h_m) {
  return surface_point(ellipsoid, u) + h_m * u;
}

dvec3 ecef_from_geodetic(const Ellipsoid& ellipsoid, const Geodetic& geodetic) {
  return ecef_from_normal(ellipsoid, normal_from_degrees(geodetic.lat_deg, geodetic.lon_deg), geodetic.h_m);
}

Geodetic geodetic_from_ecef(const Ellipsoid& ellipsoid, const dvec3& ecef) {
  if (ecef == dvec3(0.0)) return {90.0, 0.0, -ellipsoid.b(), true};
  const GeographicLib::Geocentric earth(ellipsoid.a, ellipsoid.f);
  Geodetic result;
  earth.Reverse(ecef.x, ecef.y, ecef.z, result.lat_deg, result.lon_deg, result.h_m);
  if (result.lon_deg >= 180.0) result.lon_deg -= 360.0;
  return result;
}

LocalFrame local_frame(double lat_deg, double lon_deg) {
  double sin_lat = 0, cos_lat = 0, sin_lon = 0, cos_lon = 0;
  GeographicLib::Math::sincosd(lat_deg, sin_lat, cos_lat);
  GeographicLib::Math::sincosd(lon_deg, sin_lon, cos_lon);
  return {{-sin_lon, cos_lon, 0.0},
          {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat},
          {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}};
}

dvec3 look_direction(const LocalFrame& frame, double heading_deg, double pitch_deg) {
  double sin_h = 0, cos_h = 0, sin_p = 0, cos_p = 0;
  GeographicLib::Math::sincosd(heading_deg, sin_h, cos_h);
  GeographicLib::Math::sincosd(pitch_deg, sin_p, cos_p);
  return cos_p * (sin_h * frame.east + cos_h * frame.north) + sin_p * frame.up;
}

double ray_ellipsoid(const Ellipsoid& ellipsoid, double h_m, const dvec3& origin, const dvec3& direction) {
  const double a = ellipsoid.a + h_m;
  const double b = ellipsoid.b() + h_m;
  const dvec3 o{origin.x / a, origin.y / a, origin.z / b};
  const dvec3 d{direction.x / a, direction.y / a, direction.z / b};
  const double dd = glm::dot(d, d);
  const double od = glm::dot(o, d);
  // Discriminant from the distance of the nearest point to the centre: no cancellation of od² against dd·oo.
  const dvec3 nearest = o - (od / dd) * d;
  const double gap = 1.0 - glm::dot(nearest, nearest);
  if (gap < 0.0) return -1.0;
  const double half = std::sqrt(gap / dd);
  const double t = -od / dd - half;
  return t >= 0.0 ? t : -od / dd + half >= 0.0 ? -od / dd + half : -1.0;
}

}  // namespace globe::geo
