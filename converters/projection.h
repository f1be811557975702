#pragma once

#include <cstddef>
#include <limits>

#include "globe/geo/ellipsoid.h"

namespace converters {

/// Sample coordinates as one number each; (0, 0) is the first sample's own place, x along rows, y down.
struct SamplePoint {
  double x = 0, y = 0;

  /// What a direction has that lies nowhere on the map.
  static constexpr SamplePoint nowhere() {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  bool is_somewhere() const { return x == x; }
};

/// Where directions lie in a raster whose rows are no parallels: a map projection, another datum, a rotated
/// grid, control points. What it answers for a direction depends on nothing else; any thread may ask.
class Projection {
 public:
  virtual ~Projection() = default;

  /// Sample coordinates of geodetic normals. SamplePoint::nowhere() for those that are off the raster by more
  /// than `reach` radians and some samples, and where the projection leads nowhere.
  virtual void find(const globe::geo::dvec3* directions, std::size_t count, double reach,
                    SamplePoint* out) const = 0;

  /// Samples in 90 degrees of a great circle at the raster's middle, along the denser axis.
  virtual double samples_per_quadrant() const = 0;

  /// Columns in 360 degrees of longitude, when columns are longitudes; else 0.
  virtual double turn() const = 0;
};

}  // namespace converters
