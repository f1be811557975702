#pragma once

#include <memory>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace globe::geo {

/// The shortest path on an ellipsoid's surface between two places.
struct Geodesic {
  double s12_m = 0;
  double azi1_deg = 0;  ///< at its beginning, clockwise from north, (-180, 180]
  double azi2_deg = 0;  ///< the same at its end, forward: the direction in which it would go on
};

/// Geodesics of one ellipsoid. Copies share what was computed for it; safe to call from any thread.
/// @approximation geodesics.ellipsoid, geodesics.sphere
/// Heights are not looked at. Where several paths are shortest the one taken is GeographicLib's: between
/// opposite places, on a sphere or an oblate ellipsoid, by way of the north pole; from a place to itself it
/// has azimuth 180 (from a pole: that of the longitudes). Karney's series up to |f| = 0.02, his elliptic
/// integrals beyond.
/// Error: s12 15 nm on WGS84, 5 nm on a sphere of the Earth's size (tests/hard/geodesic_test).
/// Source: Karney 2013, Algorithms for geodesics, J. Geodesy 87.
class GeodesicSolver {
 public:
  /// Throws UsageError for b/a outside [0.01, 100], where nothing is known of the error.
  explicit GeodesicSolver(const Ellipsoid& ellipsoid);

  Geodesic inverse(const Geodetic& a, const Geodetic& b) const;

  /// Places on the geodesic from a to b at equal distances, the first and the last exactly a and b
  /// (longitudes between them in [-180, 180), heights 0). REQUIRES: count >= 2.
  std::vector<Geodetic> places_along(const Geodetic& a, const Geodetic& b, std::size_t count) const;

 private:
  struct Solver;
  std::shared_ptr<const Solver> solver_;
};

}  // namespace globe::geo
