#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "converters/projection.h"
#include "converters/raster_source.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

enum class Latitude { kGeodetic, kGeocentric };

/// Where a map has its samples: an equirectangular map of the planet or of a part of it, or, when it has a
/// projection, any raster.
///
/// Sample coordinates: (x, y) = (0, 0) is the first sample's own place, x grows eastwards, y southwards (with
/// a projection: along and down the raster). Columns of a map that goes all around repeat with `period`. Rows
/// beyond a pole that such a map reaches are those of the opposite meridian; elsewhere beyond the raster
/// there is nothing.
struct MapGeometry {
  static constexpr int kNoPole = -1;

  int width = 0;
  int height = 0;
  int period = 0;           ///< columns in 360 degrees of a map that goes all around, else 0
  double west_deg = 0;      ///< longitude of x = 0
  double north_deg = 90;    ///< latitude of y = 0
  double step_deg = 0;      ///< between columns
  double row_step_deg = 0;  ///< between rows
  /// Row -k is row k - north_shift of the opposite meridian: 1 for areas, 0 for points; kNoPole where rows
  /// end short of the pole. Likewise at the south.
  int north_shift = kNoPole;
  int south_shift = kNoPole;
  Latitude latitude = Latitude::kGeodetic;
  double one_minus_f = 1;  ///< b/a of the ellipsoid, for geocentric rows
  std::shared_ptr<const Projection> projection;
  int factor = 1;          ///< samples of the projection made into one, each way
  bool as_thesis = false;  ///< directions are looked up where the thesis has them (thesis_mapping.h)

  bool is_whole_planet() const { return north_shift != kNoPole && south_shift != kNoPole; }
  /// Whether find_places takes directions of any length.
  bool takes_any_length() const { return !projection && !as_thesis; }
  int columns() const { return period > 0 ? period : width; }

  /// Samples in 90 degrees.
  double samples_per_quadrant() const;
};

/// Throws globe::Error when the map does not span the whole planet with square samples.
MapGeometry whole_planet_geometry(const std::string& name, int width, int height, const Extent& extent,
                                  Registration registration, Latitude latitude,
                                  const globe::geo::Ellipsoid& ellipsoid);

/// An equirectangular map of any part of the planet. Extents within a hundredth of a sample of a whole turn
/// or of a pole are taken to mean it: files round what they say. Throws globe::Error when the extent goes
/// beyond a pole or more than twice around.
MapGeometry equirectangular_geometry(const std::string& name, int width, int height, const Extent& extent,
                                     Registration registration, Latitude latitude,
                                     const globe::geo::Ellipsoid& ellipsoid);

/// A raster that a projection finds its way in.
MapGeometry projected_geometry(int width, int height, std::shared_ptr<const Projection> projection);

/// The same map with factor x factor samples made into one; what is left over at the end makes a last one.
MapGeometry reduced(const MapGeometry& geometry, int factor);

/// A sample coordinate as whole and fraction, so that moving by whole periods is exact.
struct SampleCoordinate {
  int whole;
  double fraction;  ///< [0, 1)
};

/// Of a geodetic normal. On a map that goes all around x lies in [-1, period). One and the same direction
/// always gives the same bits.
struct SamplePlace {
  SampleCoordinate x, y;

  static constexpr int kNowhere = -(1 << 30);  ///< x.whole and y.whole of a direction that is not on the map
  bool is_somewhere() const { return x.whole != kNowhere; }
};
SamplePlace place_of(const MapGeometry& geometry, const globe::geo::dvec3& u);

/// The same for many, of unit length unless the map takes any. Those that are off the map by more than
/// `reach` radians need not be found.
void find_places(const MapGeometry& geometry, const globe::geo::dvec3* directions, std::size_t count,
                 double reach, SamplePlace* out);

/// Whether a place lies on the map: no farther than half a sample from its outermost ones.
bool is_on(const MapGeometry& geometry, const SamplePlace& place);

/// Geodetic latitude in degrees of a row coordinate, clamped to the poles. REQUIRES: no projection.
double latitude_of(const MapGeometry& geometry, double y);

/// Area of a sample of a row, up to a factor that all rows of the map share.
double row_weight(const MapGeometry& geometry, double y);

/// The same of many.
void row_weights(const MapGeometry& geometry, const double* y, std::size_t count, double* out);

/// Column and row inside the map of any column and row; rows at most one map height beyond a pole.
/// REQUIRES: a map that goes all around.
struct SampleIndex {
  int x, y;
};
SampleIndex fold(const MapGeometry& geometry, int x, int y);

/// Whether there is a row y, on the map or beyond a pole that it reaches.
bool has_row(const MapGeometry& geometry, int y);

}  // namespace converters
