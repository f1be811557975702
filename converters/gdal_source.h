#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "converters/gdal_dataset.h"
#include "converters/raster_source.h"

namespace converters {

/// What a raster file says of where its samples lie.
struct Georeference {
  /// x = t[0] + t[1] column + t[2] row, y = t[3] + t[4] column + t[5] row; columns and rows count from the
  /// outer corner of the first sample, in the order in which read_rows gives rows.
  std::optional<std::array<double, 6>> transform;
  bool has_points = false;  ///< control points or geolocation arrays instead
  std::string crs;          ///< WKT of the horizontal part; "" when the file names none
  std::string crs_name;
  std::optional<Registration> registration;  ///< when the file says so; `transform` allows for it
};

/// How a raster is read, where that is not left to what the file says.
struct ReadingRule {
  bool as_heights = true;        ///< the first band; else red, green and blue, or grey
  std::optional<double> nodata;  ///< in place of the file's own
};

/// A raster that GDAL reads. Rows come north first where the file's own transform has them the other way
/// round and is not rotated.
class GdalSource : public RasterSource {
 public:
  /// Null when GDAL does not know what kind of file it is. Throws globe::Error when it is a kind that GDAL
  /// knows, but holds no raster to use, or its header claims an absurd size.
  static std::unique_ptr<GdalSource> open(const std::filesystem::path& path, const ReadingRule& rule,
                                          int threads);
  ~GdalSource() override;

  const RasterInfo& info() const override { return info_; }
  void read_rows(int count, void* out) override;

  const Georeference& georeference() const { return georeference_; }
  bool is_flipped() const { return flipped_; }
  /// The type that OpenImageIO would give as it is.
  bool is_plain_type() const { return plain_type_; }

 private:
  struct Palette;

  GdalSource(std::string path, DatasetHandle dataset, const ReadingRule& rule);
  void find_georeference();
  void choose_bands(const ReadingRule& rule);
  void describe(const ReadingRule& rule);
  void read_chunk();
  void read_band(int band, int x, int width, std::size_t channel);
  void read_mask(int y, int rows, std::size_t channel);
  [[noreturn]] void fail(const std::string& why) const;

  std::string path_;
  DatasetHandle dataset_;
  RasterInfo info_;
  Georeference georeference_;
  std::vector<int> bands_;
  std::vector<std::optional<double>> nodata_;  ///< of each band
  std::unique_ptr<Palette> palette_;
  bool flipped_ = false;
  bool plain_type_ = false;
  bool signed_bytes_ = false;
  bool file_mask_ = false;  ///< the mask is the file's own, else it says where all bands are nodata
  int next_row_ = 0;
  int chunk_rows_ = 1, chunk_columns_ = 1;
  int chunk_first_ = 0, chunk_count_ = 0;
  std::vector<std::byte> chunk_;
};

}  // namespace converters
