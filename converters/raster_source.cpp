#include "converters/raster_source.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "globe/base/error.h"

namespace converters {
namespace {

SampleType sample_type(const OIIO::TypeDesc& type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
      return SampleType::kUint8;
    case OIIO::TypeDesc::UINT16:
      return SampleType::kUint16;
    case OIIO::TypeDesc::INT16:
      return SampleType::kInt16;
    default:
      return SampleType::kFloat;
  }
}

OIIO::TypeDesc oiio_type(SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::kUint16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::kInt16:
      return OIIO::TypeDesc::INT16;
    case SampleType::kFloat:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

class ImageSource : public RasterSource {
 public:
  ImageSource(const std::filesystem::path& path, int threads) : path_(path) {
    if (!std::filesystem::is_regular_file(path)) {
      throw globe::Error(path.string(), "no such file", "check the name");
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    input_ = OIIO::ImageInput::open(path.string(), &config);
    if (!input_) fail(OIIO::geterror());
    input_->threads(threads);
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.width > kMaxSide || spec.height > kMaxSide ||
        spec.nchannels < 1 || spec.depth > 1) {
      fail("its header claims " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
           " samples");
    }
    info_.name = path.filename().string();
    info_.width = spec.width;
    info_.height = spec.height;
    info_.channels = std::min(spec.nchannels, 4);
    info_.has_mask = spec.alpha_channel == info_.channels - 1 && info_.channels > 1;
    info_.type = sample_type(spec.format);
    info_.linear_light =
        spec.get_string_attribute("oiio:ColorSpace") == "Linear" || info_.type == SampleType::kFloat;
    info_.description = spec.get_string_attribute("ImageDescription");
  }

  const RasterInfo& info() const override { return info_; }

  void read_rows(int count, void* out) override {
    const OIIO::ImageSpec& spec = input_->spec();
    const std::size_t row_bytes = static_cast<std::size_t>(info_.width) *
                                  static_cast<std::size_t>(info_.channels) * size_of(info_.type);
    auto* to = static_cast<std::byte*>(out);
    if (spec.tile_width == 0) {
      const int y = spec.y + next_row_;
      if (!input_->read_scanlines(0, 0, y, y + count, 0, 0, info_.channels, oiio_type(info_.type), to)) {
        fail(input_->geterror());
      }
      next_row_ += count;
      return;
    }
    for (; count > 0; --count, ++next_row_, to += row_bytes) {
      const int in_band = next_row_ % spec.tile_height;
      if (in_band == 0) read_band(row_bytes);
      std::memcpy(to, band_.data() + static_cast<std::size_t>(in_band) * row_bytes, row_bytes);
    }
  }

 private:
  /// Tiled files come one row of tiles at a time.
  void read_band(std::size_t row_bytes) {
    const OIIO::ImageSpec& spec = input_->spec();
    const int end = std::min(next_row_ + spec.tile_height, spec.height);
    band_.resize(static_cast<std::size_t>(end - next_row_) * row_bytes);
    if (!input_->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + next_row_, spec.y + end, 0, 1, 0,
                            info_.channels, oiio_type(info_.type), band_.data())) {
      fail(input_->geterror());
    }
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw globe::Error(path_.string(), "not a readable image (" + one_line(why) + ")",
                       "check that the file is whole; oiiotool --info shows what it is");
  }

  std::filesystem::path path_;
  std::unique_ptr<OIIO::ImageInput> input_;
  RasterInfo info_;
  int next_row_ = 0;
  std::vector<std::byte> band_;
};

}  // namespace

std::size_t size_of(SampleType type) {
  return type == SampleType::kUint8 ? 1 : type == SampleType::kFloat ? sizeof(float) : 2;
}

std::unique_ptr<RasterSource> open_image(const std::filesystem::path& path, int threads) {
  return std::make_unique<ImageSource>(path, threads);
}

}  // namespace converters
