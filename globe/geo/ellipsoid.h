#pragma once

#include <glm/vec3.hpp>

namespace globe::geo {

using glm::dvec3;

/// Geodetic coordinates: degrees and metres. Latitude first, as everywhere in this project.
struct Geodetic {
  double lat_deg = 0;      ///< geodetic latitude, [-90, 90]
  double lon_deg = 0;      ///< longitude, any size on input, [-180, 180) on output
  double h_m = 0;          ///< height above the ellipsoid
  bool at_center = false;  ///< the ellipsoid's centre, where no normal is defined (geodetic_from_ecef only)
};

/// An ellipsoid of revolution: equatorial radius a (metres) and flattening f.
///
/// Points on it are named by their geodetic normal u, the unit vector
/// (cos φ cos λ, cos φ sin λ, sin φ) of geodetic latitude φ and longitude λ; HTM lives on the sphere of these
/// normals.
struct Ellipsoid {
  double a = 6378137.0;
  double f = 1.0 / 298.257223563;

  double b() const { return a * (1.0 - f); }
  /// Authalic-like scale used where a single radius will do (level choice, atmosphere): (2a + b) / 3.
  double mean_radius() const { return (2.0 * a + b()) / 3.0; }

  friend bool operator==(const Ellipsoid&, const Ellipsoid&) = default;
};

inline constexpr Ellipsoid kWgs84{};
inline constexpr Ellipsoid kMoon{1737400.0, 0.0};
inline constexpr Ellipsoid kMars{3396190.0, 1.0 / 169.89444722361179};  // IAU 2000

/// Factor for lengths of a person's size, such as how near the ground a camera comes: 1, on bodies of less
/// than 1000 km of radius in proportion to it.
inline double small_body_scale(const Ellipsoid& ellipsoid) {
  constexpr double kSmall_m = 1e6;
  return ellipsoid.mean_radius() < kSmall_m ? ellipsoid.mean_radius() / kSmall_m : 1.0;
}

/// Ellipsoid from a (metres, > 0) and f (< 1), with a polar radius that is a length; else throws UsageError.
Ellipsoid make_ellipsoid(double a, double f);

/// Geodetic normal of a latitude and longitude in degrees.
///
/// The angles are folded in degrees first, which is exact, so that longitudes 0, 90, 180, 270 and the poles
/// land exactly on the axes, and 45 degrees on HTM's vertices of level 1; signed zeros are made positive.
/// Latitudes outside [-90, 90] and NaN: asserted against. The same bits on every machine (geo/sine_cosine.h);
/// for many at once see geo/normals.h.
dvec3 normal_from_degrees(double lat_deg, double lon_deg);

/// Latitude and longitude in degrees ([-180, 180)) of a direction of any length; h_m is 0.
/// At a pole the longitude is 0.
Geodetic degrees_from_normal(const dvec3& u);

/// Point of the ellipsoid's surface whose normal is u (unit), ECEF metres, without trigonometry:
/// E(u) = (a²uₓ, a²u_y, b²u_z) / √(a²uₓ² + a²u_y² + b²u_z²).
dvec3 surface_point(const Ellipsoid& ellipsoid, const dvec3& u);

/// E(u) + h u, ECEF metres.
dvec3 ecef_from_normal(const Ellipsoid& ellipsoid, const dvec3& u, double h_m);

/// ECEF metres of geodetic coordinates; error one rounding of the coordinate.
dvec3 ecef_from_geodetic(const Ellipsoid& ellipsoid, const Geodetic& geodetic);

/// Geodetic coordinates of an ECEF point (GeographicLib::Geocentric; at most 7 nm within 5000 km of the
/// surface; 4 ulp of the coordinates farther out). The centre is flagged, and answers latitude 90, longitude
/// 0, h = -b.
Geodetic geodetic_from_ecef(const Ellipsoid& ellipsoid, const dvec3& ecef);

/// Local east, north, up at a geodetic normal. At a pole east is +y turned by the longitude given (degrees).
struct LocalFrame {
  dvec3 east, north, up;
};
LocalFrame local_frame(double lat_deg, double lon_deg);

/// Unit direction of a heading (degrees clockwise from north) and pitch (degrees above the horizontal).
dvec3 look_direction(const LocalFrame& frame, double heading_deg, double pitch_deg);

/// Distance from the origin along a ray (origin, unit direction; metres) to the ellipsoid grown by h_m on
/// both axes; negative when the ray misses it or it lies behind.
double ray_ellipsoid(const Ellipsoid& ellipsoid, double h_m, const dvec3& origin, const dvec3& direction);

}  // namespace globe::geo
