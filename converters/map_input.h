#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "converters/map_geometry.h"
#include "converters/raster_projection.h"
#include "converters/raster_source.h"
#include "converters/source_map.h"

namespace converters {

/// A map to convert: a file and what is known of it. What is not given is taken from the file, else assumed
/// (longitudes -180 to 180, areas, metres) and said so.
struct MapInput {
  std::filesystem::path path;  ///< or a sub-dataset, NETCDF:"file.nc":topo
  std::optional<Extent> extent = std::nullopt;
  std::optional<Registration> registration = std::nullopt;
  std::optional<std::string> crs =
      std::nullopt;  ///< coordinate reference system: EPSG:32610, PROJ or WKT text
  std::optional<double> nodata = std::nullopt;
  std::optional<double> scale = std::nullopt;      ///< of heights: (raw * scale + offset) * unit are metres
  std::optional<double> offset = std::nullopt;     ///< in the unit
  std::optional<std::string> unit = std::nullopt;  ///< "m", "ft", ... (metres_of_unit)
};

/// A map whose file is open.
struct OpenedMap {
  std::unique_ptr<RasterSource> raster;
  RasterInfo info;  ///< of the raster
  MapGeometry geometry;
  ValueRule rule;
  std::string frame;   ///< in words: extent or coordinate reference system, registration, and who says so
  std::string values;  ///< likewise of heights: nodata, scale, offset, unit
};

/// Opens a map and finds out where it lies: by GDAL when that finds georeferencing or samples that
/// OpenImageIO would change, else by OpenImageIO. Throws globe::Error when the file is missing, unreadable or
/// lies nowhere on a planet.
OpenedMap open_map(const MapInput& input, MapKind kind, const PlanetFrame& frame, int threads);

/// Metres in a unit of length as files spell it (m, metre, km, ft, "US survey foot" ...).
std::optional<double> metres_of_unit(const std::string& unit);

}  // namespace converters
