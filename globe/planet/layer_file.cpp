#include "globe/planet/layer_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <vector>

#include "globe/base/error.h"
#include "globe/planet/grid.h"
#include "globe/planet/planet_file.h"

namespace globe::planet {
namespace {

OIIO::TypeDesc type_of(const std::string& storage) {
  assert(storage == "float32" || storage == "uint8");
  return storage == "uint8" ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
}

/// Classic TIFF ends at 4 GiB, and libtiff would choose by the first level alone. The bound is for samples
/// that do not compress at all.
bool needs_big_tiff(const OIIO::ImageSpec& finest) {
  constexpr std::uint64_t kSafe = 3'500'000'000;
  return finest.image_bytes() / 3 * 4 > kSafe;
}

/// One tile of a level; what lies beyond the level repeats its last row and column. (Left to itself,
/// OpenImageIO fills such tiles with whatever was in memory, and files differ from run to run.)
void cut_tile(const void* samples, int side, std::size_t sample_bytes, int x, int y, int tile_size,
              std::vector<std::byte>& tile) {
  const auto t = static_cast<std::size_t>(tile_size);
  tile.resize(t * t * sample_bytes);
  const auto inside = static_cast<std::size_t>(std::min(tile_size, side - x));
  for (std::size_t row = 0; row < t; ++row) {
    const auto from_y = static_cast<std::size_t>(std::min(y + static_cast<int>(row), side - 1));
    const auto* from = static_cast<const std::byte*>(samples) +
                       (from_y * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)) * sample_bytes;
    std::byte* to = tile.data() + row * t * sample_bytes;
    std::memcpy(to, from, inside * sample_bytes);
    for (std::size_t column = inside; column < t; ++column)
      std::memcpy(to + column * sample_bytes, from + (inside - 1) * sample_bytes, sample_bytes);
  }
}

}  // namespace

struct LayerFileWriter::State {
  std::filesystem::path path;
  std::unique_ptr<OIIO::ImageOutput> output;
  OIIO::TypeDesc type;
  int level;  ///< of the next call
  int channels;
  int tile_size;
  bool first = true;
  int big_tiff = 0;

  [[noreturn]] void fail() const {
    throw Error(path.string(), "cannot be written (" + output->geterror() + ")",
                "check the space left on the disk");
  }
};

LayerFileWriter::LayerFileWriter(const std::filesystem::path& path, int level, int channels,
                                 const std::string& storage, int tile_size)
    : state_(
          new State{path, OIIO::ImageOutput::create("tif"), type_of(storage), level, channels, tile_size}) {
  state_->output->threads(1);  // callers write the four diamonds from tasks of their own
}

LayerFileWriter::~LayerFileWriter() = default;

void LayerFileWriter::write_level(const void* samples, const std::function<void(int rows)>& written) {
  State& s = *state_;
  assert(s.level >= 0);
  const int side = nodes_per_side(s.level) + 1;
  OIIO::ImageSpec spec(side, side, s.channels, s.type);
  spec.tile_width = spec.tile_height = s.tile_size;
  spec.attribute("compression", "zip");
  spec.attribute("tiff:zipquality", 4);  // within 3 % of the size of 6 on relief, twice as quick
  spec.attribute("textureformat", "Plain Texture");
  spec.attribute("planarconfig", "contig");
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  spec.attribute("Software", "globe");
  if (s.first) s.big_tiff = needs_big_tiff(spec) ? 1 : 0;
  spec.attribute("tiff:bigtiff", s.big_tiff);
  const auto mode = s.first ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage;
  if (!s.output->open(s.path.string(), spec, mode)) s.fail();
  s.first = false;
  std::vector<std::byte> tile;
  for (int y = 0; y < side; y += s.tile_size) {
    for (int x = 0; x < side; x += s.tile_size) {
      cut_tile(samples, side, static_cast<std::size_t>(s.channels) * s.type.size(), x, y, s.tile_size, tile);
      if (!s.output->write_tile(x, y, 0, s.type, tile.data())) s.fail();
    }
    if (written) written(std::min(s.tile_size, side - y));
  }
  --s.level;
}

void LayerFileWriter::finish() {
  assert(state_->level == -1);
  if (!state_->output->close()) state_->fail();
  sync_to_disk(state_->path);
}

}  // namespace globe::planet
