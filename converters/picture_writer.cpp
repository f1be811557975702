#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "converters/map_writer.h"
#include "converters/srgb.h"
#include "globe/base/error.h"

namespace converters {
namespace {

constexpr int kRows = 32;     ///< of a block: a multiple of those that EXR compresses together
constexpr int kPngLevel = 4;  ///< zlib's
constexpr double kFull = 65535.0;

/// A file that remembers when the disk did not take all: OpenImageIO's PNG writer does not look.
class CheckedFile : public OIIO::Filesystem::IOFile {
 public:
  explicit CheckedFile(const std::string& path) : IOFile(path, Write), opened_(m_file != nullptr) {}

  std::size_t write(const void* bytes, std::size_t size) override {
    const std::size_t written = IOFile::write(bytes, size);
    short_ = short_ || written != size;
    return written;
  }

  /// Hands everything to the system; false when anything was lost.
  bool finish() { return opened_ && !short_ && std::fflush(m_file) == 0 && std::ferror(m_file) == 0; }

 private:
  bool opened_;
  bool short_ = false;
};

class PictureWriter : public MapWriter {
 public:
  PictureWriter(const std::filesystem::path& path, const MapDescription& map)
      : MapWriter(map.window.width, kRows),
        path_(path),
        map_(map),
        is_exr_(path.extension() == ".exr"),
        file_(path.string()),
        output_(OIIO::ImageOutput::create(path.string())) {
    if (!output_) fail(OIIO::geterror());
    const bool heights = map.content == MapContent::kHeights;
    const OIIO::TypeDesc type = is_exr_   ? OIIO::TypeDesc::FLOAT
                                : heights ? OIIO::TypeDesc::UINT16
                                          : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(map.window.width, map.window.height, map.channels(), type);
    if (is_exr_) {
      spec.attribute("compression", "zip");
      if (heights) spec.channelnames = {"height"};
    } else {
      spec.attribute("png:compressionLevel", kPngLevel);
      spec.attribute("oiio:ColorSpace", heights ? "Linear" : "sRGB");
    }
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // else today's
    spec.attribute("Software", "globe");
    spec.attribute("ImageDescription", description());
    output_->set_ioproxy(&file_);
    if (!output_->open(path.string(), spec)) fail(output_->geterror());
  }

  void write(int, int y0, int nx, int ny, const float* values) override {
    const auto count = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
                       static_cast<std::size_t>(map_.channels());
    if (is_exr_) {
      put(y0, ny, OIIO::TypeDesc::FLOAT, values);
    } else if (map_.content == MapContent::kColors) {
      bytes_.resize(count);
      std::transform(values, values + count, bytes_.begin(), srgb_byte_from_linear);
      put(y0, ny, OIIO::TypeDesc::UINT8, bytes_.data());
    } else {
      words_.resize(count);
      const double scale = kFull / (map_.high_m - map_.low_m);
      std::transform(values, values + count, words_.begin(), [&](float metres) {
        return static_cast<std::uint16_t>(
            std::lround(std::clamp((static_cast<double>(metres) - map_.low_m) * scale, 0.0, kFull)));
      });
      put(y0, ny, OIIO::TypeDesc::UINT16, words_.data());
    }
  }

  void finish() override {
    if (!output_->close()) fail(output_->geterror());
    if (!file_.finish()) fail("the disk did not take it all");
  }

 private:
  void put(int y0, int ny, const OIIO::TypeDesc& type, const void* rows) {
    if (!output_->write_scanlines(y0, y0 + ny, 0, type, rows)) fail(output_->geterror());
  }

  /// Neither format has a place for where the map lies.
  std::string description() const {
    const MapWindow& window = map_.window;
    char where[160];
    std::snprintf(where, sizeof where,
                  "longitudes %.10g to %.10g, latitudes %.10g to %.10g, pixels are areas", window.west_deg,
                  window.longitude(window.width), window.latitude(window.height), window.north_deg);
    std::string text = where;
    if (map_.content == MapContent::kHeights) {
      char unit[96] = "; height in metres";
      if (!is_exr_) {
        std::snprintf(unit, sizeof unit, "; height in metres = %.10g + value / 65535 * %.10g", map_.low_m,
                      map_.high_m - map_.low_m);
      }
      text += unit + (", vertical datum " + map_.vertical_datum);
    }
    for (const std::string& credit : map_.credits) text += "; " + credit;
    return text;
  }

  [[noreturn]] void fail(std::string why) const {
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw globe::Error(path_.string(), "cannot be written (" + why + ")", "check the space left on the disk");
  }

  std::filesystem::path path_;
  MapDescription map_;
  bool is_exr_;
  CheckedFile file_;  ///< outlives what writes to it
  std::unique_ptr<OIIO::ImageOutput> output_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> words_;
};

}  // namespace

std::unique_ptr<MapWriter> make_picture_writer(const std::filesystem::path& path, const MapDescription& map) {
  return std::make_unique<PictureWriter>(path, map);
}

void require_map_name(const std::filesystem::path& path) {
  for (const char* extension : {".tif", ".png", ".exr"}) {
    if (path.extension() == extension) return;
  }
  throw globe::UsageError(path.string(), "maps are written as .tif, .png or .exr, meshes as .glb",
                          "give a name that ends so");
}

std::unique_ptr<MapWriter> make_map_writer(const std::filesystem::path& path, const MapDescription& map,
                                           int threads) {
  if (path.extension() == ".tif") return make_geotiff_writer(path, map, threads);
  return make_picture_writer(path, map);
}

}  // namespace converters
