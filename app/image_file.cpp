#include "app/image_file.h"

#include <OpenImageIO/imageio.h>

#include <cassert>

#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace app {
namespace {

using globe::Error;
using globe::PendingFile;

/// EXR carries a date; OpenImageIO would take today's.
constexpr const char* kDate = "1970:01:01 00:00:00";
/// zlib's level. A noisy 1280x720 takes 62 ms at level 2, 204 at the usual 6, which saves 6 % of the bytes.
constexpr int kPngLevel = 2;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(path.string(), why, "check the folder and the free space of the disk");
}

void write(const std::filesystem::path& path, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
           const void* pixels, OIIO::stride_t pixel_bytes) {
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output) fail(path, OIIO::geterror());
  if (!output->open(path.string(), spec) || !output->write_image(type, pixels, pixel_bytes) ||
      !output->close()) {
    fail(path, output->geterror());
  }
}

void require_extension(const std::filesystem::path& path, const char* extension) {
  if (path.extension() == extension) return;
  throw globe::UsageError(path.string(), "this picture is written as " + std::string(extension),
                          "give a name that ends so");
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  assert(picture.rgba.size() ==
         static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4);
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", kPngLevel);
  write(path, spec, OIIO::TypeDesc::UINT8, picture.rgba.data(), 4);
}

void write_image(const std::filesystem::path& path, const Picture& picture, bool overwrite) {
  require_extension(path, ".png");
  PendingFile file(path, overwrite);
  write_png(file.temporary(), picture);
  file.publish();
}

void write_image(const std::filesystem::path& path, int width, int height,
                 const std::vector<std::string>& channels, std::span<const float> pixels, bool overwrite) {
  assert(pixels.size() ==
         static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels.size());
  require_extension(path, ".exr");
  PendingFile file(path, overwrite);
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", kDate);
  write(file.temporary(), spec, OIIO::TypeDesc::FLOAT, pixels.data(), OIIO::AutoStride);
  file.publish();
}

}  // namespace app
