#include "globe/planet/tiff_level.h"

#include <tiffio.h>

#include <algorithm>
#include <cassert>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "globe/base/error.h"
#include "globe/planet/tile_packer.h"

namespace globe::planet {
namespace {

int keep_message(TIFF* /*file*/, void* message, const char* module, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  *static_cast<std::string*>(message) = std::string(module) + ": " + text;
  return 1;
}

int ignore_warning(TIFF* /*file*/, void* /*message*/, const char* /*module*/, const char* /*format*/,
                   va_list /*arguments*/) {
  return 1;
}

/// Little-endian on every machine, so that the bytes are the same.
TIFF* open(const std::filesystem::path& path, const char* mode, std::string& message) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, keep_message, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_warning, nullptr);
  TIFF* file = TIFFOpenExt(path.c_str(), mode, options);
  TIFFOpenOptionsFree(options);
  return file;
}

}  // namespace

std::size_t TiffLevel::sample_bytes() const {
  assert(storage == "float32" || storage == "uint8");
  return static_cast<std::size_t>(channels) * (storage == "uint8" ? 1 : sizeof(float));
}

std::size_t TiffLevel::tile_bytes() const {
  return static_cast<std::size_t>(tile_size) * static_cast<std::size_t>(tile_size) * sample_bytes();
}

void cut_tile(const SampleRect& rect, int x, int y, const TiffLevel& level, std::vector<std::byte>& tile) {
  const auto t = static_cast<std::size_t>(level.tile_size);
  const std::size_t bytes = level.sample_bytes();
  tile.resize(level.tile_bytes());
  const auto inside = static_cast<std::size_t>(std::min(level.tile_size, rect.width - x));
  for (std::size_t row = 0; row < t; ++row) {
    const auto from_y = static_cast<std::size_t>(std::min(y + static_cast<int>(row), rect.height - 1));
    const auto* from = static_cast<const std::byte*>(rect.first) +
                       (from_y * static_cast<std::size_t>(rect.stride) + static_cast<std::size_t>(x)) * bytes;
    std::byte* to = tile.data() + row * t * bytes;
    std::memcpy(to, from, inside * bytes);
    for (std::size_t column = inside; column < t; ++column)
      std::memcpy(to + column * bytes, from + (inside - 1) * bytes, bytes);
  }
}

void TiffWriter::Closer::operator()(tiff* file) const { TIFFClose(file); }

TiffWriter::TiffWriter(const std::filesystem::path& path, bool big)
    : path_(path), packer_(std::make_unique<TilePacker>()) {
  file_.reset(open(path, big ? "w8l" : "wl", message_));
  if (!file_) fail();
}

TiffWriter::~TiffWriter() = default;

void TiffWriter::begin_level(const TiffLevel& level) {
  level_ = level;
  TIFF* file = file_.get();
  const bool bytes = level.storage == "uint8";
  const auto set = [&](std::uint32_t tag, auto value) {
    if (TIFFSetField(file, tag, value) != 1) fail();
  };
  set(TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(level.width));
  set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(level.height));
  set(TIFFTAG_TILEWIDTH, static_cast<std::uint32_t>(level.tile_size));
  set(TIFFTAG_TILELENGTH, static_cast<std::uint32_t>(level.tile_size));
  set(TIFFTAG_SAMPLESPERPIXEL, level.channels);
  set(TIFFTAG_BITSPERSAMPLE, bytes ? 8 : 32);
  set(TIFFTAG_SAMPLEFORMAT, bytes ? SAMPLEFORMAT_UINT : SAMPLEFORMAT_IEEEFP);
  set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  set(TIFFTAG_PHOTOMETRIC, level.channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  const int usual = level.channels < 3 ? 1 : 3;
  if (level.channels > usual) {
    const std::vector<std::uint16_t> extra(static_cast<std::size_t>(level.channels - usual),
                                           EXTRASAMPLE_UNSPECIFIED);
    if (TIFFSetField(file, TIFFTAG_EXTRASAMPLES, level.channels - usual, extra.data()) != 1) fail();
  }
  set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  set(TIFFTAG_PREDICTOR, bytes ? PREDICTOR_HORIZONTAL : PREDICTOR_FLOATINGPOINT);
  // OpenImageIO then reads the levels as those of a texture.
  set(TIFFTAG_PIXAR_TEXTUREFORMAT, "Plain Texture");
  set(TIFFTAG_SOFTWARE, "globe");
}

std::uint32_t TiffWriter::tile_index(int ti, int tj) const {
  assert(ti >= 0 && ti < level_.tiles_across() && tj >= 0 && tj < level_.tiles_down());
  return static_cast<std::uint32_t>(tj * level_.tiles_across() + ti);
}

void TiffWriter::write_tile(int ti, int tj, const std::vector<std::byte>& tile) {
  write_raw_tile(ti, tj, packer_->pack(level_, tile));
}

void TiffWriter::write_raw_tile(int ti, int tj, const std::vector<std::byte>& bytes) {
  const auto size = static_cast<tmsize_t>(bytes.size());
  if (TIFFWriteRawTile(file_.get(), tile_index(ti, tj), const_cast<std::byte*>(bytes.data()), size) != size)
    fail();
}

void TiffWriter::end_level() {
  if (TIFFWriteDirectory(file_.get()) != 1) fail();
}

void TiffWriter::finish() {
  if (TIFFFlush(file_.get()) != 1) fail();
  file_.reset();
  if (!message_.empty()) fail();
}

void TiffWriter::fail() const {
  throw Error(path_.string(), "cannot be written (" + (message_.empty() ? "not flushed" : message_) + ")",
              "check the space left on the disk");
}

void TiffTiles::Closer::operator()(tiff* file) const { TIFFClose(file); }

TiffTiles::TiffTiles(const std::filesystem::path& path) : path_(path) {
  file_.reset(open(path, "r", message_));
  if (!file_ || TIFFIsTiled(file_.get()) == 0) fail();
}

TiffTiles::~TiffTiles() = default;

int TiffTiles::count() const { return static_cast<int>(TIFFNumberOfTiles(file_.get())); }

void TiffTiles::raw_tile(int index, std::vector<std::byte>& bytes) const {
  const auto tile = static_cast<std::uint32_t>(index);
  bytes.resize(TIFFGetStrileByteCount(file_.get(), tile));
  const auto size = static_cast<tmsize_t>(bytes.size());
  if (bytes.empty() || TIFFReadRawTile(file_.get(), tile, bytes.data(), size) != size) fail();
}

void TiffTiles::fail() const {
  throw Error(path_.string(), "cannot be read (" + (message_.empty() ? "not tiled" : message_) + ")",
              "convert the map again");
}

}  // namespace globe::planet
