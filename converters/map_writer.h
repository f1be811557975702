#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "converters/map_window.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

enum class MapContent {
  kHeights,  ///< one channel, metres
  kColors,   ///< three channels, linear light
};

/// What a map says of itself.
struct MapDescription {
  MapWindow window;
  MapContent content = MapContent::kHeights;
  globe::geo::Ellipsoid ellipsoid;
  std::string body;            ///< as PlanetInfo::body
  std::string vertical_datum;  ///< of heights
  std::vector<std::string> credits;
  std::optional<double> nodata;  ///< of heights in a GeoTIFF
  /// Of 16-bit heights: the metres of 0 and 65535.
  double low_m = 0;
  double high_m = 1;

  int channels() const { return content == MapContent::kHeights ? 1 : 3; }
};

/// A map file in the making. It takes blocks of pixels, row by row of blocks, each row from west to east.
class MapWriter {
 public:
  virtual ~MapWriter() = default;

  /// Pixels of a block; those on the eastern and southern border may be smaller.
  int block_width() const { return block_width_; }
  int block_height() const { return block_height_; }

  /// The next block, values as MapContent has them, channels interleaved; the caller's threads, one at a
  /// time. Throws globe::Error when the disk does not take it.
  virtual void write(int x0, int y0, int nx, int ny, const float* values) = 0;

  /// Ends the file. Throws globe::Error.
  virtual void finish() = 0;

 protected:
  MapWriter(int block_width, int block_height) : block_width_(block_width), block_height_(block_height) {}

 private:
  int block_width_;
  int block_height_;
};

/// Throws globe::UsageError for names that do not end in .tif, .png or .exr.
void require_map_name(const std::filesystem::path& path);

/// By the name's extension: .tif (GeoTIFF), .png or .exr. Throws globe::Error when the file cannot be made.
/// REQUIRES: require_map_name(path).
/// @param threads  that may compress
std::unique_ptr<MapWriter> make_map_writer(const std::filesystem::path& path, const MapDescription& map,
                                           int threads);

/// Tiled, deflated GeoTIFF: heights as float metres, colors as sRGB bytes; pixels are areas, the coordinate
/// system is geographic on the planet's own ellipsoid (EPSG:4326 on WGS 84).
std::unique_ptr<MapWriter> make_geotiff_writer(const std::filesystem::path& path, const MapDescription& map,
                                               int threads);

/// PNG: colors as 8-bit sRGB, heights as 16 bits from low_m to high_m, clamped. EXR: float metres, or linear
/// light.
std::unique_ptr<MapWriter> make_picture_writer(const std::filesystem::path& path, const MapDescription& map);

}  // namespace converters
