#include "converters/gdal_source.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "converters/use_gdal.h"
#include "globe/base/error.h"

namespace converters {
namespace {

constexpr int kLeastChunk = 16;
constexpr int kMostChunk = 512;
constexpr int kSamplesAtOnce = 1 << 20;  ///< of a band, read by one call

GDALDataType gdal_type(SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return GDT_Byte;
    case SampleType::kUint16:
      return GDT_UInt16;
    case SampleType::kInt16:
      return GDT_Int16;
    case SampleType::kFloat:
      break;
  }
  return GDT_Float32;
}

SampleType sample_type(GDALDataType type) {
  switch (type) {
    case GDT_Byte:
      return SampleType::kUint8;
    case GDT_UInt16:
      return SampleType::kUint16;
    case GDT_Int16:
      return SampleType::kInt16;
    default:
      return SampleType::kFloat;
  }
}

void put(std::byte* to, SampleType type, int value) {
  switch (type) {
    case SampleType::kUint8:
      *to = static_cast<std::byte>(value);
      return;
    case SampleType::kUint16:
    case SampleType::kInt16: {
      const auto v = static_cast<std::uint16_t>(value);
      std::memcpy(to, &v, sizeof v);
      return;
    }
    case SampleType::kFloat: {
      const auto v = static_cast<float>(value);
      std::memcpy(to, &v, sizeof v);
    }
  }
}

double number_at(const std::byte* from, SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return std::to_integer<int>(*from);
    case SampleType::kUint16: {
      std::uint16_t value = 0;
      std::memcpy(&value, from, sizeof value);
      return value;
    }
    case SampleType::kInt16: {
      std::int16_t value = 0;
      std::memcpy(&value, from, sizeof value);
      return value;
    }
    case SampleType::kFloat:
      break;
  }
  float value = 0;  // NaN where it was nodata
  std::memcpy(&value, from, sizeof value);
  return static_cast<double>(value);
}

bool is_valid(double value, double nodata) { return value != nodata && !std::isnan(value); }

bool is_rotated(const std::array<double, 6>& t) { return t[2] != 0.0 || t[4] != 0.0; }

/// A text of a vertical reference system: "ellipsoid" for one in three dimensions, "" for none.
std::string vertical_datum_of(const OGRSpatialReference& crs) {
  if (crs.IsCompound()) {
    const char* name = crs.GetAttrValue("VERT_CS");
    return name != nullptr ? name : "";
  }
  return crs.GetAxesCount() == 3 ? "ellipsoid" : "";
}

}  // namespace

struct GdalSource::Palette {
  std::vector<GDALColorEntry> colors;
  const GDALColorEntry& at(unsigned index) const {
    static constexpr GDALColorEntry kNone{0, 0, 0, 0};
    return index < colors.size() ? colors[index] : kNone;
  }
};

GdalSource::~GdalSource() = default;

std::unique_ptr<GdalSource> GdalSource::open(const std::filesystem::path& path, const ReadingRule& rule,
                                             int threads) {
  DatasetHandle dataset = open_dataset(path.string(), threads);
  if (!dataset) return nullptr;
  return std::unique_ptr<GdalSource>(new GdalSource(path.string(), std::move(dataset), rule));
}

GdalSource::GdalSource(std::string path, DatasetHandle dataset, const ReadingRule& rule)
    : path_(std::move(path)), dataset_(std::move(dataset)) {
  info_.width = dataset_->GetRasterXSize();
  info_.height = dataset_->GetRasterYSize();
  if (dataset_->GetRasterCount() == 0) {
    std::string names;
    char** list = dataset_->GetMetadata("SUBDATASETS");
    for (int k = 1; const char* name = CSLFetchNameValue(list, CPLSPrintf("SUBDATASET_%d_NAME", k)); ++k)
      names += (names.empty() ? "" : ", ") + std::string(name);
    throw globe::Error(path_, names.empty() ? "holds no raster" : "holds several rasters",
                       names.empty() ? "give a raster" : "give one of " + names);
  }
  if (info_.width > kMaxSide || info_.height > kMaxSide)
    fail("its header claims " + std::to_string(info_.width) + "x" + std::to_string(info_.height) +
         " samples");
  choose_bands(rule);
  describe(rule);
  find_georeference();
  int block_width = 0, block_height = 0;
  dataset_->GetRasterBand(bands_.front())->GetBlockSize(&block_width, &block_height);
  chunk_rows_ = std::clamp(block_height, std::min(kLeastChunk, info_.height),
                           std::max(1, std::min(kMostChunk, info_.height)));
  const int at_once = kSamplesAtOnce / chunk_rows_ / block_width * block_width;
  chunk_columns_ = std::clamp(at_once, std::min(block_width, info_.width), info_.width);
}

void GdalSource::choose_bands(const ReadingRule& rule) {
  const int count = dataset_->GetRasterCount();
  const auto meaning = [&](int band) { return dataset_->GetRasterBand(band)->GetColorInterpretation(); };
  bands_ = {1};
  if (rule.as_heights) return;
  std::vector<int> plain;
  std::array<int, 3> named{};
  for (int band = 1; band <= count; ++band) {
    const GDALColorInterp interp = meaning(band);
    if (interp != GCI_AlphaBand) plain.push_back(band);
    if (interp >= GCI_RedBand && interp <= GCI_BlueBand)
      named[static_cast<std::size_t>(interp - GCI_RedBand)] = band;
  }
  if (std::count(named.begin(), named.end(), 0) == 0) {
    bands_.assign(named.begin(), named.end());
  } else if (plain.size() >= 3) {
    bands_.assign(plain.begin(), plain.begin() + 3);
  } else if (!plain.empty()) {
    bands_ = {plain.front()};
  }
  const GDALColorTable* table = dataset_->GetRasterBand(bands_.front())->GetColorTable();
  if (bands_.size() == 1 && table != nullptr) {
    palette_ = std::make_unique<Palette>();
    for (int k = 0; k < table->GetColorEntryCount(); ++k) {
      GDALColorEntry color{};
      table->GetColorEntryAsRGB(k, &color);
      palette_->colors.push_back(color);
    }
  }
}

void GdalSource::describe(const ReadingRule& rule) {
  GDALRasterBand* first = dataset_->GetRasterBand(bands_.front());
  GDALDataType type = first->GetRasterDataType();
  for (const int band : bands_)
    type = GDALDataTypeUnion(type, dataset_->GetRasterBand(band)->GetRasterDataType());
  if (GDALDataTypeIsComplex(type)) fail("its samples are complex numbers");
  plain_type_ = sample_type(type) != SampleType::kFloat || type == GDT_Float32;
  const char* bits = first->GetMetadataItem("NBITS", "IMAGE_STRUCTURE");
  const char* pixel_type = first->GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
  signed_bytes_ = type == GDT_Byte && pixel_type != nullptr && pixel_type == std::string("SIGNEDBYTE");
  info_.type = signed_bytes_ ? SampleType::kInt16 : palette_ ? SampleType::kUint8 : sample_type(type);
  info_.linear_light = info_.type == SampleType::kFloat;
  const int used_bits = bits != nullptr ? std::atoi(bits) : 0;
  if (!palette_ && used_bits > 0 && used_bits < 8 * static_cast<int>(size_of(info_.type)))
    info_.white = (1 << used_bits) - 1;

  bool all_have_nodata = true;
  for (const int band : bands_) {
    int has = 0;
    const double nodata = dataset_->GetRasterBand(band)->GetNoDataValue(&has);
    nodata_.push_back(rule.nodata ? rule.nodata : has != 0 ? std::optional(nodata) : std::nullopt);
    all_have_nodata = all_have_nodata && nodata_.back();
  }
  const int mask = first->GetMaskFlags();
  file_mask_ = (mask & GMF_PER_DATASET) != 0;
  info_.has_mask = file_mask_ || (!rule.as_heights && all_have_nodata);
  if (rule.as_heights) info_.nodata = nodata_.front();
  info_.channels = static_cast<int>(palette_ ? 3 : bands_.size()) + (info_.has_mask ? 1 : 0);

  info_.name = std::filesystem::path(path_).filename().string();
  if (rule.as_heights) {
    info_.scale = first->GetScale();
    info_.offset = first->GetOffset();
    info_.unit = first->GetUnitType();
  }
  const char* description = dataset_->GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION");
  if (description != nullptr) info_.description = description;
}

void GdalSource::find_georeference() {
  std::array<double, 6> transform{};
  const bool placed = dataset_->GetGeoTransform(transform.data()) == CE_None;
  const OGRSpatialReference* crs = dataset_->GetSpatialRef();
  OGRSpatialReference of_arrays;
  if (!placed) {
    georeference_.has_points =
        dataset_->GetGCPCount() >= 3 || dataset_->GetMetadata("GEOLOCATION") != nullptr;
    if (georeference_.has_points && crs == nullptr) crs = dataset_->GetGCPSpatialRef();
    const char* named = dataset_->GetMetadataItem("SRS", "GEOLOCATION");
    if (crs == nullptr && named != nullptr && of_arrays.importFromWkt(named) == OGRERR_NONE) crs = &of_arrays;
  } else {
    flipped_ = !is_rotated(transform) && transform[5] > 0.0;
    if (flipped_) {
      transform[3] += transform[5] * info_.height;
      transform[5] = -transform[5];
    }
    georeference_.transform = transform;
  }
  const char* registered = dataset_->GetMetadataItem("AREA_OR_POINT");
  if (registered != nullptr)
    georeference_.registration =
        registered == std::string("Point") ? Registration::kPoint : Registration::kArea;
  if (crs == nullptr) return;
  info_.vertical_datum = vertical_datum_of(*crs);
  const std::unique_ptr<OGRSpatialReference> flat(crs->Clone());
  if (flat->IsCompound()) flat->StripVertical();
  if (flat->GetAxesCount() == 3) flat->DemoteTo2D(nullptr);
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2018", nullptr};
  if (flat->exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) georeference_.crs = text;
  CPLFree(text);
  if (flat->GetName() == nullptr) return;
  georeference_.crs_name = flat->GetName();
  info_.description += " " + georeference_.crs_name;
}

void GdalSource::read_rows(int count, void* out) {
  const std::size_t row_bytes =
      static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(info_.channels) * size_of(info_.type);
  auto* to = static_cast<std::byte*>(out);
  for (; count > 0; --count, ++next_row_, to += row_bytes) {
    const int row = flipped_ ? info_.height - 1 - next_row_ : next_row_;
    if (row < chunk_first_ || row >= chunk_first_ + chunk_count_) {
      chunk_first_ = row / chunk_rows_ * chunk_rows_;
      chunk_count_ = std::min(chunk_rows_, info_.height - chunk_first_);
      chunk_.resize(static_cast<std::size_t>(chunk_count_) * row_bytes);
      read_chunk();
    }
    std::memcpy(to, chunk_.data() + static_cast<std::size_t>(row - chunk_first_) * row_bytes, row_bytes);
  }
}

void GdalSource::read_chunk() {
  forget_failures();
  const auto samples = static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(chunk_count_);
  const auto channels = static_cast<std::size_t>(info_.channels);
  const std::size_t size = size_of(info_.type);
  if (palette_) {
    std::vector<std::uint16_t> index(samples);
    if (dataset_->GetRasterBand(bands_.front())
            ->RasterIO(GF_Read, 0, chunk_first_, info_.width, chunk_count_, index.data(), info_.width,
                       chunk_count_, GDT_UInt16, 0, 0, nullptr) != CE_None)
      fail(first_failure());
    for (std::size_t k = 0; k < samples; ++k) {
      const GDALColorEntry& color = palette_->at(index[k]);
      const short parts[] = {color.c1, color.c2, color.c3};
      for (std::size_t c = 0; c < 3; ++c) chunk_[k * channels + c] = static_cast<std::byte>(parts[c]);
    }
  } else {
    // By columns of blocks: GDAL goes line by line, and would decode blocks again that its cache does not
    // hold.
    for (int x = 0; x < info_.width; x += chunk_columns_) {
      const int width = std::min(chunk_columns_, info_.width - x);
      for (std::size_t c = 0; c < bands_.size(); ++c) read_band(bands_[c], x, width, c);
    }
  }
  if (info_.has_mask) read_mask(chunk_first_, chunk_count_, channels - 1);
  if (!signed_bytes_) return;
  for (std::size_t k = 0; k < samples * channels; ++k) {
    std::uint16_t value = 0;
    std::memcpy(&value, chunk_.data() + k * size, size);
    put(chunk_.data() + k * size, info_.type, static_cast<std::int8_t>(value));
  }
}

/// Columns x .. x + width - 1 of the chunk.
void GdalSource::read_band(int band, int x, int width, std::size_t channel) {
  const std::size_t size = size_of(info_.type);
  const std::size_t stride = static_cast<std::size_t>(info_.channels) * size;
  const std::size_t line = stride * static_cast<std::size_t>(info_.width);
  GDALRasterBand* from = dataset_->GetRasterBand(band);
  const bool wide = info_.type == SampleType::kFloat && from->GetRasterDataType() != GDT_Float32;
  std::byte* to = chunk_.data() + static_cast<std::size_t>(x) * stride + channel * size;
  const auto columns = static_cast<std::size_t>(width);
  std::vector<double> values(wide ? columns * static_cast<std::size_t>(chunk_count_) : 0);
  const CPLErr result =
      wide ? from->RasterIO(GF_Read, x, chunk_first_, width, chunk_count_, values.data(), width, chunk_count_,
                            GDT_Float64, 0, 0, nullptr)
           : from->RasterIO(GF_Read, x, chunk_first_, width, chunk_count_, to, width, chunk_count_,
                            gdal_type(info_.type), static_cast<GSpacing>(stride), static_cast<GSpacing>(line),
                            nullptr);
  if (result != CE_None) fail(first_failure());
  if (info_.type != SampleType::kFloat) return;
  // Numbers too wide for a float are compared before they are rounded to one.
  const std::optional<double> nodata = nodata_[channel];
  for (std::size_t y = 0; y < static_cast<std::size_t>(chunk_count_); ++y) {
    for (std::size_t k = 0; k < columns; ++k) {
      std::byte* at = to + y * line + k * stride;
      float value = 0;
      if (wide) {
        const double number = values[y * columns + k];
        value = nodata && number == *nodata ? NAN : static_cast<float>(number);
      } else {
        std::memcpy(&value, at, size);
        if (nodata && value == static_cast<float>(*nodata)) value = NAN;
      }
      std::memcpy(at, &value, size);
    }
  }
}

/// 1 where the file's mask is set, or else where some band is not nodata.
void GdalSource::read_mask(int y, int rows, std::size_t channel) {
  const std::size_t size = size_of(info_.type);
  const std::size_t stride = static_cast<std::size_t>(info_.channels) * size;
  const auto samples = static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(rows);
  std::vector<std::uint8_t> valid(samples, 0);
  if (file_mask_ || palette_) {
    GDALRasterBand* mask = dataset_->GetRasterBand(bands_.front())->GetMaskBand();
    if (mask->RasterIO(GF_Read, 0, y, info_.width, rows, valid.data(), info_.width, rows, GDT_Byte, 0, 0,
                       nullptr) != CE_None)
      fail(first_failure());
  } else {
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t c = 0; c < channel; ++c)
        if (is_valid(number_at(chunk_.data() + k * stride + c * size, info_.type), *nodata_[c])) valid[k] = 1;
    }
  }
  for (std::size_t k = 0; k < samples; ++k)
    put(chunk_.data() + k * stride + channel * size, info_.type, valid[k] != 0 ? 1 : 0);
}

void GdalSource::fail(const std::string& why) const {
  throw globe::Error(path_, "not a readable raster (" + (why.empty() ? "cannot be decoded" : why) + ")",
                     "check that the file is whole; gdalinfo shows what it is");
}

}  // namespace converters
