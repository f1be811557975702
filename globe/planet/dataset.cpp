#include "globe/planet/dataset.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <tbb/enumerable_thread_specific.h>

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

/// A pyramid in a file: of a layer's diamond, or of an inset's block.
struct Pyramid {
  std::string path;
  OIIO::ImageCache::ImageHandle* handle = nullptr;
  std::string storage;
  int channels = 1;
  InsetBlock nodes;  ///< of its finest level
  int finest_level = 0;

  InsetBlock nodes_of(int level) const { return nodes.coarser(finest_level - level); }
};

constexpr const char* kRemedy = "convert the map again";
constexpr const char* kInsetRemedy = "make the inset again, with --overwrite";

/// Checks size, type, tiles and levels of one file, before anything else may touch it.
void check_file(const Pyramid& pyramid, const StoredFile& file, int tile_size, const char* remedy) {
  const std::filesystem::path path = pyramid.path;
  const OIIO::TypeDesc type = pyramid.storage == "uint8" ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
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
  for (int level = pyramid.finest_level; level >= 0 && !pyramid.nodes_of(level).empty(); --level) {
    const InsetBlock nodes = pyramid.nodes_of(level);
    const OIIO::ImageSpec spec = input->spec_dimensions(0, pyramid.finest_level - level);
    const bool good = spec.width == nodes.i1 - nodes.i0 + 1 && spec.height == nodes.j1 - nodes.j0 + 1 &&
                      spec.nchannels == pyramid.channels && spec.format == type &&
                      spec.tile_width == tile_size && spec.tile_height == tile_size;
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

bool is_left_out(const LayerChoice& layers, const std::string& name) {
  return name == "color" ? !layers.colors : !layers.heights;
}

void leave_out(const LayerChoice& choice, PlanetFile& file) {
  const auto layer = [&](const LayerInfo& info) { return is_left_out(choice, info.name); };
  const auto inset = [&](const InsetInfo& info) { return !choice.insets || is_left_out(choice, info.layer); };
  std::erase_if(file.layers, [&](const StoredLayer& stored) { return layer(stored.info); });
  std::erase_if(file.info.layers, layer);
  std::erase_if(file.insets, [&](const StoredInset& stored) { return inset(stored.info); });
  std::erase_if(file.info.insets, inset);
}

}  // namespace

struct Dataset::State {
  struct Layer {
    StoredLayer stored;
    std::array<Pyramid, kDiamonds> diamonds;  ///< none where no level is stored
  };
  /// Of one inset, by name: a file for each of its blocks.
  struct InsetSamples {
    std::string what;
    std::vector<Pyramid> blocks;
  };

  PlanetInfo info;
  std::vector<Layer> layers;
  std::vector<std::vector<InsetSamples>> insets;
  CachePtr cache;
  /// What the cache keeps for each thread. Left to itself it finds that by its own address, and threads that
  /// outlive a cache then bring what they kept to the next one in the same place: a crash.
  mutable tbb::enumerable_thread_specific<OIIO::ImageCache::Perthread*> threads;

  ~State() {
    for (OIIO::ImageCache::Perthread* thread : threads) cache->destroy_thread_info(thread);
  }
  OIIO::ImageCache::Perthread* this_thread() const {
    bool known = false;
    OIIO::ImageCache::Perthread*& thread = threads.local(known);
    if (!known) thread = cache->create_thread_info();
    return thread;
  }

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

  void open_file(Pyramid& pyramid, const StoredFile& file, const char* remedy) const {
    check_file(pyramid, file, info.tile_size, remedy);
    pyramid.handle = cache->get_image_handle(OIIO::ustring(pyramid.path));
  }

  void open_layer(const std::filesystem::path& folder, StoredLayer stored);
  void open_inset(const std::filesystem::path& folder, const StoredInset& stored);

  /// Copies the part of a window that a pyramid holds out of the tiles it touches, Stored being the type on
  /// disk.
  template <typename Stored, typename T>
  void copy_window(const Pyramid& pyramid, int level, int i0, int j0, int ni, int nj, T* out) const;
};

template <typename Stored, typename T>
void Dataset::State::copy_window(const Pyramid& pyramid, int level, int i0, int j0, int ni, int nj,
                                 T* out) const {
  const int t = info.tile_size;
  const InsetBlock held = pyramid.nodes_of(level);
  const int first_i = std::max(i0, held.i0), last_i = std::min(i0 + ni - 1, held.i1);
  const int first_j = std::max(j0, held.j0), last_j = std::min(j0 + nj - 1, held.j1);
  if (last_i < first_i || last_j < first_j) return;
  const auto channels = static_cast<std::size_t>(pyramid.channels);
  OIIO::ImageCache::Perthread* thread = this_thread();
  for (int tj = (first_j - held.j0) / t * t; tj <= last_j - held.j0; tj += t) {
    for (int ti = (first_i - held.i0) / t * t; ti <= last_i - held.i0; ti += t) {
      OIIO::ImageCache::Tile* tile =
          cache->get_tile(pyramid.handle, thread, 0, pyramid.finest_level - level, ti, tj, 0);
      OIIO::TypeDesc type;
      const void* pixels = tile != nullptr ? cache->tile_pixels(tile, type) : nullptr;
      if (pixels == nullptr || type.basetype != OIIO::BaseTypeFromC<Stored>::value) {
        std::string reason = cache->geterror();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        if (tile != nullptr) cache->release_tile(tile);
        throw Error(pyramid.path,
                    "tile " + std::to_string(ti / t) + "," + std::to_string(tj / t) + " of level " +
                        std::to_string(level) + " cannot be decoded (" + reason + ")",
                    kRemedy);
      }
      const int begin = std::max(first_i, held.i0 + ti);
      const int end = std::min(last_i + 1, held.i0 + ti + t);
      const auto count = static_cast<std::size_t>(end - begin) * channels;
      for (int j = std::max(first_j, held.j0 + tj); j <= std::min(last_j, held.j0 + tj + t - 1); ++j) {
        const auto from = static_cast<std::size_t>(j - held.j0 - tj) * static_cast<std::size_t>(t) +
                          static_cast<std::size_t>(begin - held.i0 - ti);
        const auto to = static_cast<std::size_t>(j - j0) * static_cast<std::size_t>(ni) +
                        static_cast<std::size_t>(begin - i0);
        copy_samples(static_cast<const Stored*>(pixels) + from * channels, count, out + to * channels);
      }
      cache->release_tile(tile);
    }
  }
}

void Dataset::State::open_layer(const std::filesystem::path& folder, StoredLayer stored) {
  Layer layer{std::move(stored), {}};
  const LayerInfo& of = layer.stored.info;
  const int finest = layer.stored.stored_level;
  for (std::size_t d = 0; d < layer.stored.files.size(); ++d) {
    const int n = nodes_per_side(finest);
    layer.diamonds[d] = {(folder / layer.stored.files[d].name).string(),
                         nullptr,
                         of.storage,
                         of.channels,
                         {static_cast<int>(d), 0, n, 0, n},
                         finest};
    open_file(layer.diamonds[d], layer.stored.files[d], kRemedy);
  }
  layers.push_back(std::move(layer));
}

void Dataset::State::open_inset(const std::filesystem::path& folder, const StoredInset& stored) {
  std::vector<InsetSamples> samples;
  const std::vector<InsetFile> files = inset_files(stored.info.layer);
  for (std::size_t f = 0; f < files.size(); ++f) {
    samples.push_back({files[f].what, {}});
    for (std::size_t b = 0; b < stored.info.blocks.size(); ++b) {
      Pyramid pyramid{(folder / stored.files[b][f].name).string(),
                      nullptr,
                      files[f].storage,
                      files[f].channels,
                      stored.info.blocks[b].coarser(files[f].levels_coarser),
                      stored.info.level - files[f].levels_coarser};
      open_file(pyramid, stored.files[b][f], kInsetRemedy);
      samples.back().blocks.push_back(std::move(pyramid));
    }
  }
  insets.push_back(std::move(samples));
}

Dataset Dataset::open(const std::filesystem::path& folder, std::size_t cache_bytes,
                      const LayerChoice& layers) {
  PlanetFile file = read_planet_file(folder);
  leave_out(layers, file);
  auto state = std::make_shared<State>();
  state->info = std::move(file.info);
  state->cache = make_cache(cache_bytes);
  for (StoredLayer& stored : file.layers) state->open_layer(folder, std::move(stored));
  for (const StoredInset& inset : file.insets) state->open_inset(folder, inset);
  for (const State::Layer& layer : state->layers) {
    const State::Layer* height = state->find("height");
    if (layer.stored.info.level > layer.stored.stored_level &&
        (height == nullptr || height->stored.stored_level < layer.stored.info.level ||
         layer.stored.info.channels != 1)) {
      throw Error((folder / kPlanetFileName).string(),
                  "layer '" + layer.stored.info.name + "' lacks its finest levels", kRemedy);
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
  const Pyramid& pyramid = state_->holder(name, level).diamonds[static_cast<std::size_t>(d)];
  if (pyramid.storage == "uint8") {
    state_->copy_window<std::uint8_t>(pyramid, level, i0, j0, ni, nj, out);
  } else {
    state_->copy_window<float>(pyramid, level, i0, j0, ni, nj, out);
  }
}

void Dataset::read(std::string_view name, int d, int level, int i0, int j0, int ni, int nj,
                   std::uint8_t* out) const {
  assert(d >= 0 && d < kDiamonds && i0 >= 0 && j0 >= 0 && i0 + ni <= nodes_per_side(level) + 1 &&
         j0 + nj <= nodes_per_side(level) + 1);
  const Pyramid& pyramid = state_->holder(name, level).diamonds[static_cast<std::size_t>(d)];
  assert(pyramid.storage == "uint8");
  state_->copy_window<std::uint8_t>(pyramid, level, i0, j0, ni, nj, out);
}

void Dataset::read_inset(std::size_t inset, std::string_view what, int d, int level, int i0, int j0, int ni,
                         int nj, float* out) const {
  const std::vector<State::InsetSamples>& of = state_->insets[inset];
  const auto samples =
      std::find_if(of.begin(), of.end(), [&](const State::InsetSamples& one) { return one.what == what; });
  assert(samples != of.end() && level <= samples->blocks.front().finest_level);
  const auto count = static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj);
  std::fill_n(out, count * static_cast<std::size_t>(samples->blocks.front().channels), 0.0F);
  for (const Pyramid& block : samples->blocks) {
    if (block.nodes.d != d) continue;
    if (block.storage == "uint8") {
      state_->copy_window<std::uint8_t>(block, level, i0, j0, ni, nj, out);
    } else {
      state_->copy_window<float>(block, level, i0, j0, ni, nj, out);
    }
  }
}

}  // namespace globe::planet
