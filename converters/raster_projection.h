#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "converters/gdal_source.h"
#include "converters/map_geometry.h"
#include "converters/projection.h"

namespace converters {

/// How rows of a raster become latitudes of the planet.
struct PlanetFrame {
  globe::geo::Ellipsoid ellipsoid;
  Latitude latitude = Latitude::kGeodetic;
};

/// How a raster lies on the planet: its transform or control points, then its coordinate reference system, by
/// PROJ. On the Earth (an ellipsoid that is WGS 84) coordinates are brought to WGS 84; on other planets, and
/// where the system is that of another body, its own latitudes and longitudes are taken as they are.
///
/// One operation of PROJ serves the whole raster, the best for its middle, so that a place does not depend on
/// what it is asked together with.
class RasterProjection : public Projection {
 public:
  /// `path` is opened again for control points, by each thread that asks. Throws globe::Error when the system
  /// is unknown or does not lie on a planet.
  RasterProjection(const std::string& path, int width, int height, const Georeference& reference,
                   const PlanetFrame& frame);
  ~RasterProjection() override;

  void find(const globe::geo::dvec3* directions, std::size_t count, double reach,
            SamplePoint* out) const override;
  double samples_per_quadrant() const override;
  double turn() const override;

  /// The raster as an equirectangular map, edges of its samples, when it is one to a ten-thousandth of a
  /// sample, north row first.
  std::optional<Extent> as_extent() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace converters
