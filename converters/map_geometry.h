#pragma once

#include <string>

#include "converters/raster_source.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

enum class Registration { kArea, kPoint };
enum class Latitude { kGeodetic, kGeocentric };

/// Where an equirectangular map of the whole planet has its samples.
///
/// Sample coordinates: (x, y) = (0, 0) is the first sample's own place, x grows eastwards, y southwards.
/// Columns repeat with `period`. Rows beyond a pole are those of the opposite meridian.
struct MapGeometry {
  int width = 0;
  int height = 0;
  int period = 0;         ///< columns in 360 degrees
  double west_deg = 0;    ///< longitude of x = 0
  double north_deg = 90;  ///< latitude of y = 0
  double step_deg = 0;    ///< between samples, both ways
  int pole_shift = 1;  ///< row -k is row k - pole_shift of the opposite meridian: 1 for areas, 0 for points
  Latitude latitude = Latitude::kGeodetic;
  double one_minus_f = 1;  ///< b/a of the ellipsoid, for geocentric rows

  /// Samples in 90 degrees.
  double samples_per_quadrant() const { return period / 4.0; }
};

/// Throws globe::Error when the map does not span the whole planet with square samples.
MapGeometry whole_planet_geometry(const std::string& name, int width, int height, const Extent& extent,
                                  Registration registration, Latitude latitude,
                                  const globe::geo::Ellipsoid& ellipsoid);

/// The same map with factor x factor samples made into one.
MapGeometry reduced(const MapGeometry& geometry, int factor);

/// A sample coordinate as whole and fraction, so that moving by whole periods is exact.
struct SampleCoordinate {
  int whole;
  double fraction;  ///< [0, 1)
};

/// Of a geodetic normal; x lies in [-1, period). One and the same direction always gives the same bits.
struct SamplePlace {
  SampleCoordinate x, y;
};
SamplePlace place_of(const MapGeometry& geometry, const globe::geo::dvec3& u);

/// Geodetic latitude in degrees of a row coordinate, clamped to the poles.
double latitude_of(const MapGeometry& geometry, double y);

/// Column and row inside the map of any column and row; rows at most one map height beyond a pole.
struct SampleIndex {
  int x, y;
};
SampleIndex fold(const MapGeometry& geometry, int x, int y);

}  // namespace converters
