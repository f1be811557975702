#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "converters/convert.h"
#include "converters/map_sampler.h"
#include "converters/map_writer.h"

namespace converters {

struct MapSize {
  int width = 0, height = 0;
};

struct ExportOptions {
  std::filesystem::path output;       ///< .tif, .png or .exr
  std::optional<MapContent> content;  ///< default: colors for a .png of a planet that has them, else heights
  Extent extent;                      ///< west < east <= west + 360, whatever longitudes
  std::optional<MapSize> size;        ///< default: as many pixels along the equator as the level has cells
  std::optional<int> level;  ///< default: the data's, in a part of the planet an inset's; finer: synthesised
  std::optional<Sampling> sampling;  ///< default: area where pixels are larger than cells, else linear
  /// Metres that a 16-bit picture of heights spans; default: the lowest and highest of the planet.
  std::optional<std::pair<double, double>> range;
  /// Metres that pixels get in a GeoTIFF whose centre leans on nodes that no map had a value for
  /// (Surface::is_filled); named in the file. NaN will do.
  std::optional<double> nodata;
  std::size_t memory_bytes = 0;  ///< for pixels on the way to the file; 0: as many as keep the threads busy
  int threads = 0;               ///< 0: all cores
  bool overwrite = false;
};

/// Writes a planet's heights or colors as an equirectangular map, block by block: neither the map nor the
/// planet is ever held whole. The same planet and options give the same bytes, whatever the threads and
/// memory.
///
/// Where pixels are much larger than cells, `area` starts from a coarser level: the finest that leaves at
/// least four cells a pixel, whose heights and colors are filtered (of synthesised ground: sub-sampled).
/// Throws globe::Error, and leaves nothing behind; UsageError for what cannot be asked.
void export_map(const std::shared_ptr<const globe::planet::Surface>& surface, const ExportOptions& options,
                const ConvertListener& listener);

/// The level of the data: the layer's own, or for heights in a part of the planet that an inset lies in, the
/// inset's.
int default_level(const globe::planet::Surface& surface, MapContent content, const Extent& extent);

/// The level that `area` reads for a window: see export_map.
int area_level(const MapWindow& window, int finest_level);

}  // namespace converters
