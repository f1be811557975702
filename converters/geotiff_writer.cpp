#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "converters/map_writer.h"
#include "converters/srgb.h"
#include "converters/use_gdal.h"
#include "globe/base/error.h"

namespace converters {
namespace {

constexpr int kBlock = 256;
constexpr const char* kLevelOfDeflate = "ZLEVEL=4";  ///< within 3 % of the size of 6 on relief

std::string capitalised(std::string word) {
  if (!word.empty() && word[0] >= 'a' && word[0] <= 'z') word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

OGRSpatialReference reference_of(const MapDescription& map) {
  OGRSpatialReference reference;
  if (map.ellipsoid == globe::geo::kWgs84) {
    reference.importFromEPSG(4326);
  } else {
    const std::string body = map.body == "other" ? "Planet" : capitalised(map.body);
    const double inverse_f = map.ellipsoid.f == 0.0 ? 0.0 : 1.0 / map.ellipsoid.f;
    reference.SetGeogCS((body + " geodetic").c_str(), ("D_" + body).c_str(), (body + " ellipsoid").c_str(),
                        map.ellipsoid.a, inverse_f, "Reference meridian", 0.0);
  }
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

class GeoTiffWriter : public MapWriter {
 public:
  GeoTiffWriter(const std::filesystem::path& path, const MapDescription& map, int threads)
      : MapWriter(kBlock, kBlock), path_(path), map_(map) {
    use_gdal();
    const QuietGdal quiet;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const bool heights = map.content == MapContent::kHeights;
    CPLStringList options;
    for (const char* option : {"TILED=YES", "COMPRESS=DEFLATE", kLevelOfDeflate, "BIGTIFF=IF_SAFER",
                               "INTERLEAVE=PIXEL", heights ? "PREDICTOR=3" : "PREDICTOR=2"})
      options.AddString(option);
    options.SetNameValue("BLOCKXSIZE", std::to_string(kBlock).c_str());
    options.SetNameValue("BLOCKYSIZE", std::to_string(kBlock).c_str());
    options.SetNameValue("NUM_THREADS", std::to_string(threads).c_str());
    if (!heights) options.AddString("PHOTOMETRIC=RGB");
    dataset_ = driver->Create(path.c_str(), map.window.width, map.window.height, map.channels(),
                              heights ? GDT_Float32 : GDT_Byte, options.List());
    if (dataset_ == nullptr) fail();
    describe();
    if (quiet.failed()) fail();
    const std::size_t pixels = std::size_t{kBlock} * kBlock;
    if (heights) {
      metres_.resize(pixels);
    } else {
      bytes_.resize(pixels);
    }
  }
  ~GeoTiffWriter() override {
    const QuietGdal quiet;
    delete dataset_;
  }

  void write(int x0, int y0, int nx, int ny, const float* values) override {
    const QuietGdal quiet;
    // Whole tiles, one call each: GDAL's own cache would write them in an order that depends on its size.
    for (int c = 0; c < map_.channels(); ++c) {
      void* block = map_.content == MapContent::kHeights ? static_cast<void*>(metres_.data())
                                                         : static_cast<void*>(bytes_.data());
      fill_block(nx, ny, values, c);
      GDALRasterBand* band = dataset_->GetRasterBand(c + 1);
      if (band->WriteBlock(x0 / kBlock, y0 / kBlock, block) != CE_None) fail();
    }
    if (quiet.failed()) fail();
  }

  void finish() override {
    const QuietGdal quiet;
    dataset_->FlushCache(true);
    if (quiet.failed()) fail();
    delete dataset_;
    dataset_ = nullptr;
    if (quiet.failed()) fail();
  }

 private:
  /// One channel of a block; what lies beyond the map repeats its last column and row.
  void fill_block(int nx, int ny, const float* values, int c) {
    const int channels = map_.channels();
    std::size_t k = 0;
    for (int y = 0; y < kBlock; ++y) {
      const float* row = values + std::ptrdiff_t{std::min(y, ny - 1)} * nx * channels;
      for (int x = 0; x < kBlock; ++x, ++k) {
        const float value = row[std::min(x, nx - 1) * channels + c];
        if (map_.content == MapContent::kHeights) {
          metres_[k] = value;
        } else {
          bytes_[k] = srgb_byte_from_linear(value);
        }
      }
    }
  }

  void describe() {
    const MapWindow& window = map_.window;
    std::array<double, 6> transform{window.west_deg,   window.step_x_deg, 0.0, window.north_deg, 0.0,
                                    -window.step_y_deg};
    dataset_->SetGeoTransform(transform.data());
    const OGRSpatialReference reference = reference_of(map_);
    dataset_->SetSpatialRef(&reference);
    dataset_->SetMetadataItem("AREA_OR_POINT", "Area");
    dataset_->SetMetadataItem("TIFFTAG_SOFTWARE", "globe");
    std::string credits;
    for (const std::string& credit : map_.credits) credits += (credits.empty() ? "" : "; ") + credit;
    dataset_->SetMetadataItem("CREDITS", credits.c_str());
    if (map_.content == MapContent::kHeights) {
      dataset_->SetMetadataItem("VERTICAL_DATUM", map_.vertical_datum.c_str());
      dataset_->GetRasterBand(1)->SetUnitType("metre");
      if (map_.nodata) dataset_->GetRasterBand(1)->SetNoDataValue(*map_.nodata);
      dataset_->GetRasterBand(1)->SetDescription("height");
    }
  }

  [[noreturn]] void fail() const {
    std::string why = CPLGetLastErrorMsg();
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw globe::Error(path_.string(), "cannot be written (" + why + ")", "check the space left on the disk");
  }

  std::filesystem::path path_;
  MapDescription map_;
  GDALDataset* dataset_ = nullptr;
  std::vector<float> metres_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<MapWriter> make_geotiff_writer(const std::filesystem::path& path, const MapDescription& map,
                                               int threads) {
  return std::make_unique<GeoTiffWriter>(path, map, threads);
}

}  // namespace converters
