#pragma once

#include <vector>

#include "globe/geo/ellipsoid.h"

namespace globe::geo {

/// The points at one geodesic distance from a place, as a curve of their normals.
///
/// u(azimuth) is analytic, and nearly a circle on the sphere: a Fourier series of a few terms, fitted to
/// geodesics (GeographicLib), gives it to the last digits in a fiftieth of the time. The number of terms is
/// raised until the last quarter of them is below 1e-15; for the Earth 15 will do.
/// Error: 5e-15 rad (geodesic_circle_test), most of it that of the geodesics.
class GeodesicCircle {
 public:
  /// @param center  latitude and longitude; h is not looked at
  /// @param radius_m  at least 0
  GeodesicCircle(const Ellipsoid& ellipsoid, const Geodetic& center, double radius_m);

  /// Normal (unit) at an azimuth, radians from north clockwise.
  dvec3 at(double azimuth_rad) const;

  /// A bound of |d²u / d azimuth²|.
  double bend() const { return bend_; }

 private:
  std::vector<dvec3> cosine_, sine_;  ///< coefficients of cos kA and sin kA, k = 0, 1, ...
  double bend_ = 0;
};

/// Geodesic distance (m) between two places. Error: 15 nm on the Earth (Karney 2013).
double geodesic_distance_m(const Ellipsoid& ellipsoid, const Geodetic& a, const Geodetic& b);

/// Normal (unit) of the place where a geodesic ends that leaves a place at an azimuth (degrees from north
/// clockwise).
dvec3 geodesic_end(const Ellipsoid& ellipsoid, const Geodetic& from, double azimuth_deg, double distance_m);

/// Within this distance (m) every geodesic from any point is the shortest, so that a geodesic circle is the
/// border of the places nearer than its radius (Klingenberg's theorem).
double injectivity_radius_m(const Ellipsoid& ellipsoid);

}  // namespace globe::geo
