#include "globe/planet/dataset.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "globe/base/error.h"
#include "globe/planet/grid.h"
#include "globe/planet/planet_file.h"

namespace globe::planet {
namespace {

struct CacheDeleter {
  void operator()(OIIO::ImageCache* cache) const { OIIO::ImageCache::destroy(cache, true); }
};
using CachePtr = std::unique_ptr<OIIO::ImageCache, CacheDeleter>;

/// A cache of our own. A broken file with few handles hangs OpenImageIO 2.4, invalidate() while others read
/// aborts it: so many handles, and nothing is ever invalidated.
CachePtr make_cache(std::size_t bytes) {
  CachePtr cache(OIIO::ImageCache::create(false));
  cache->attribute("max_memory_MB", std::max(1.0F, static_cast<float>(bytes) / (1024.0F * 1024.0F)));
  cache->attribute("max_open_files", 256);
  cache->attribute("autotile", 0);
  cache->attribute("automip", 0);
  cache->attribute("accept_untiled", 0);
  cache->attribute("failure_retries", 0);
  return cache;
}

OIIO::TypeDesc type_of(const LayerInfo& layer) {
  return layer.storage == "uint8" ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
}

/// Checks size, type, tiles and levels of one file, before anything else may touch it.
void check_file(const std::filesystem::path& path, const StoredFile& file, const StoredLayer& layer,
                int tile_size) {
  const char* const remedy = "convert the map again";
  std::error_code missing;
  const std::uintmax_t bytes = std::filesystem::file_size(path, missing);
  if (missing) throw Error(path.string(), "missing or unreadable", remedy);
  if (bytes != file.bytes) {
    throw Error(path.string(),
                (bytes < file.bytes ? "truncated, " : "altered, ") + std::to_string(bytes) +
                    " bytes instead of " + std::to_string(file.bytes),
                remedy);
  }
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) throw Error(path.string(), "not a readable TIFF (" + OIIO::geterror() + ")", remedy);
  for (int level = layer.stored_level; level >= 0; --level) {
    const int side = nodes_per_side(level) + 1;
    const OIIO::ImageSpec spec = input->spec_dimensions(0, layer.stored_level - level);
    const bool good = spec.width == side && spec.height == side && spec.nchannels == layer.info.channels &&
                      spec.format == type_of(layer.info) && spec.tile_width == tile_size &&
                      spec.tile_height == tile_size;
    if (!good) {
      throw Error(path.string(), "level " + std::to_string(level) + " is not what planet.json says", remedy);
    }
  }
}

void copy_samples(const float* from, std::size_t count, float* to) { std::copy_n(from, count, to); }
void copy_samples(const std::uint8_t* from, std::size_t count, std::uint8_t* to) {
  std::copy_n(from, count, to);
}
void copy_samples(const std::uint8_t* from, std::size_t count, float* to) {
  std::transform(from, from + count, to, [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0F; });
}

}  // namespace

struct Dataset::State {
  struct Layer {
    StoredLayer stored;
    std::array<std::string, kDiamonds> paths;
    std::array<OIIO::ImageCache::ImageHandle*, kDiamonds> handles{};
  };

  PlanetInfo info;
  std::vector<Layer> layers;
  CachePtr cache;

  const Layer* find(std::string_view name) const {
    const auto it = std::find_if(layers.begin(), layers.end(),
                                 [&](const Layer& layer) { return layer.stored.info.name == name; });
    return it == layers.end() ? nullptr : &*it;
  }

  /// The layer whose files hold this level: finer levels than a layer stores are those of "height".
  const Layer& holder(std::string_view name, int level) const {
    const Layer* layer = find(name);
    assert(layer != nullptr && level >= 0 && level <= layer->stored.info.level);
    if (level <= layer->stored.stored_level) return *layer;
    const Layer* height = find("height");
    assert(height != nullptr && height->stored.stored_level >= level);
    return *height;
  }

  template <typename Stored, typename T>
  void copy_window(const Layer& layer, int d, int level, int i0, int j0, int ni, int nj, T* out) const;
};

/// Copies a window out of the tiles it touches, Stored being the type on disk.
template <typename Stored, typename T>
void Dataset::State::copy_window(const Layer& layer, int d, int level, int i0, int j0, int ni, int nj,
                                 T* out) const {
  const int t = info.tile_size;
  const int mip = layer.stored.stored_level - level;
  const auto channels = static_cast<std::size_t>(layer.stored.info.channels);
  const auto index = static_cast<std::size_t>(d);
  OIIO::ImageCache::Perthread* thread = cache->get_perthread_info();
  for (int tj = j0 / t * t; tj < j0 + nj; tj += t) {
    for (int ti = i0 / t * t; ti < i0 + ni; ti += t) {
      OIIO::ImageCache::Tile* tile = cache->get_tile(layer.handles[index], thread, 0, mip, ti, tj, 0);
      OIIO::TypeDesc type;
      const void* pixels = tile != nullptr ? cache->tile_pixels(tile, type) : nullptr;
      if (pixels == nullptr || type.basetype != OIIO::BaseTypeFromC<Stored>::value) {
        std::string reason = cache->geterror();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        if (tile != nullptr) cache->release_tile(tile);
        throw Error(layer.paths[index],
                    "tile " + std::to_string(ti / t) + "," + std::to_string(tj / t) + " of level " +
                        std::to_string(level) + " cannot be decoded (" + reason + ")",
                    "convert the map again");
      }
      const int begin = std::max(i0, ti);
      const int end = std::min(i0 + ni, ti + t);
      const auto count = static_cast<std::size_t>(end - begin) * channels;
      for (int j = std::max(j0, tj); j < std::min(j0 + nj, tj + t); ++j) {
        const auto from = static_cast<std::size_t>(j - tj) * static_cast<std::size_t>(t) +
                          static_cast<std::size_t>(begin - ti);
        const auto to = static_cast<std::size_t>(j - j0) * static_cast<std::size_t>(ni) +
                        static_cast<std::size_t>(begin - i0);
        copy_samples(static_cast<const Stored*>(pixels) + from * channels, count, out + to * channels);
      }
      cache->release_tile(tile);
    }
  }
}

Dataset Dataset::open(const std::filesystem::path& folder, std::size_t cache_bytes) {
  PlanetFile file = read_planet_file(folder);
  auto state = std::make_shared<State>();
  state->info = std::move(file.info);
  state->cache = make_cache(cache_bytes);
  for (StoredLayer& stored : file.layers) {
    State::Layer layer{std::move(stored), {}, {}};
    for (std::size_t d = 0; d < layer.stored.files.size(); ++d) {
      const std::filesystem::path path = folder / layer.stored.files[d].name;
      check_file(path, layer.stored.files[d], layer.stored, state->info.tile_size);
      layer.paths[d] = path.string();
      layer.handles[d] = state->cache->get_image_handle(OIIO::ustring(layer.paths[d]));
    }
    state->layers.push_back(std::move(layer));
  }
  for (const State::Layer& layer : state->layers) {
    const State::Layer* height = state->find("height");
    if (layer.stored.info.level > layer.stored.stored_level &&
        (height == nullptr || height->stored.stored_level < layer.stored.info.level ||
         layer.stored.info.channels != 1)) {
      throw Error((folder / kPlanetFileName).string(),
                  "layer '" + layer.stored.info.name + "' lacks its finest levels", "convert the map again");
    }
  }
  Dataset dataset;
  dataset.state_ = std::move(state);
  return dataset;
}

const PlanetInfo& Dataset::info() const { return state_->info; }

const LayerInfo* Dataset::layer(std::string_view name) const {
  const State::Layer* layer = state_->find(name);
  return layer == nullptr ? nullptr : &layer->stored.info;
}

void Dataset::read(std::string_view name, int d, int level, int i0, int j0, int ni, int nj,
                   float* out) const {
  assert(d >= 0 && d < kDiamonds && i0 >= 0 && j0 >= 0 && i0 + ni <= nodes_per_side(level) + 1 &&
         j0 + nj <= nodes_per_side(level) + 1);
  const State::Layer& layer = state_->holder(name, level);
  if (layer.stored.info.storage == "uint8") {
    state_->copy_window<std::uint8_t>(layer, d, level, i0, j0, ni, nj, out);
  } else {
    state_->copy_window<float>(layer, d, level, i0, j0, ni, nj, out);
  }
}

void Dataset::read(std::string_view name, int d, int level, int i0, int j0, int ni, int nj,
                   std::uint8_t* out) const {
  assert(d >= 0 && d < kDiamonds && i0 >= 0 && j0 >= 0 && i0 + ni <= nodes_per_side(level) + 1 &&
         j0 + nj <= nodes_per_side(level) + 1);
  const State::Layer& layer = state_->holder(name, level);
  assert(layer.stored.info.storage == "uint8");
  state_->copy_window<std::uint8_t>(layer, d, level, i0, j0, ni, nj, out);
}

}  // namespace globe::planet
