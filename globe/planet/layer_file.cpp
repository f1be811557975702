#include "globe/planet/layer_file.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "globe/base/error.h"
#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

/// Classic TIFF ends at 4 GiB. The bound is for samples that do not compress at all.
bool needs_big_tiff(const TiffLevel& finest) {
  constexpr std::uint64_t kSafe = 3'500'000'000;
  const auto side = static_cast<std::uint64_t>(finest.width);
  return side * side * finest.sample_bytes() / 3 * 4 > kSafe;
}

}  // namespace

TiffLevel layer_level(int level, int channels, const std::string& storage, int tile_size) {
  const int side = nodes_per_side(level) + 1;
  return {side, side, channels, storage, tile_size};
}

LayerFileWriter::LayerFileWriter(const std::filesystem::path& path, int level, int channels,
                                 const std::string& storage, int tile_size)
    : level_(level),
      channels_(channels),
      storage_(storage),
      tile_size_(tile_size),
      file_(path, needs_big_tiff(layer_level(level, channels, storage, tile_size))) {}

TiffLevel LayerFileWriter::next_level() {
  assert(level_ >= 0);
  const TiffLevel level = layer_level(level_--, channels_, storage_, tile_size_);
  file_.begin_level(level);
  return level;
}

void LayerFileWriter::write_level(const void* samples, const std::function<void(int rows)>& written) {
  const TiffLevel level = next_level();
  const SampleRect rect{samples, level.width, level.height, level.width};
  std::vector<std::byte> tile;
  for (int tj = 0; tj < level.tiles_down(); ++tj) {
    for (int ti = 0; ti < level.tiles_across(); ++ti) {
      cut_tile(rect, ti * tile_size_, tj * tile_size_, level, tile);
      file_.write_tile(ti, tj, tile);
    }
    if (written) written(std::min(tile_size_, level.height - tj * tile_size_));
  }
  file_.end_level();
}

void LayerFileWriter::write_level(const std::vector<std::filesystem::path>& parts,
                                  const std::function<void(int rows)>& written) {
  const TiffLevel level = next_level();
  std::vector<std::byte> bytes;
  int tile = 0;
  for (const std::filesystem::path& path : parts) {
    const TiffTiles part(path);
    for (int k = 0; k < part.count(); ++k, ++tile) {
      part.raw_tile(k, bytes);
      file_.write_raw_tile(tile % level.tiles_across(), tile / level.tiles_across(), bytes);
    }
    if (written) written(part.count() / level.tiles_across() * tile_size_);
  }
  assert(tile == level.tiles_across() * level.tiles_down());
  file_.end_level();
}

void LayerFileWriter::finish() {
  assert(level_ == -1);
  file_.finish();
}

}  // namespace globe::planet
