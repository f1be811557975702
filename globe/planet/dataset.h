#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace globe::planet {

/// One layer of a planet. Every layer is a pyramid of the four diamonds, levels `level` down to 0; level k of
/// a diamond has (2^k + 1)^2 nodes.
///
/// - "height": metres above the vertical datum, one channel. Coarser levels by sub-sampling: a coarse sample
/// *is* a
///   fine sample.
/// - "relief": the same heights, coarser levels filtered, for slopes that do not alias in shading. Its finest
/// level
///   is that of "height" and is not stored twice.
/// - "height_range": two channels, lowest and highest height of a block of cells. Sample (i, j) of level k
/// covers
///   cell (i, j) of level k, borders included; i = 2^k and j = 2^k repeat the last cell. Its finest level is
///   coarser than that of "height" (block_level in mean_height.h).
/// - "height_mean": two channels, mean height of the two trixels of a cell, half 0 and half 1 (see Cell),
/// weighted by
///   true area (mean_height.h); the same cells and levels as "height_range". Older planets lack it.
/// - "color": three channels of sRGB, coarser levels filtered in linear light.
struct LayerInfo {
  std::string name;
  int level = 0;
  int channels = 1;
  std::string storage = "float32";  ///< on disk: "float32" or "uint8"
  double min = 0;                   ///< of all samples, in the unit that Dataset::read gives as float
  double max = 0;

  friend bool operator==(const LayerInfo&, const LayerInfo&) = default;
};

struct PlanetInfo {
  std::string name;
  std::string body = "other";  ///< earth, moon, mars, other
  std::string id;              ///< hexadecimal digest of the layers' bytes and what is written beside them
  geo::Ellipsoid ellipsoid;
  std::string vertical_datum;
  int tile_size = 0;  ///< side of the tiles on disk, nodes
  std::vector<LayerInfo> layers;
  std::vector<std::string>
      credits;  ///< provenance: sources, filter, program version; no dates, no host names

  friend bool operator==(const PlanetInfo&, const PlanetInfo&) = default;
};

/// A planet on disk: a folder with planet.json and, per layer and diamond, one tiled TIFF. Samples come
/// through a cache of decoded tiles, so a planet may be larger than memory. Copies share the cache; reading
/// is thread-safe.
class Dataset {
 public:
  /// Opens the planet and checks that every file is whole (size, header, levels); `cache_bytes` caps the
  /// decoded tiles kept. Throws globe::Error with one line when there is no planet.json, it is broken or of a
  /// newer format, or a file is missing, truncated or not what planet.json says.
  static Dataset open(const std::filesystem::path& folder, std::size_t cache_bytes);

  const PlanetInfo& info() const;

  /// nullptr when the planet has no such layer.
  const LayerInfo* layer(std::string_view name) const;

  /// Nodes i0 .. i0+ni-1, j0 .. j0+nj-1 of diamond d at `level`, all inside [0, 2^level], level 0 .. the
  /// layer's: out[(j * ni + i) * channels + c]. float32 layers as stored, uint8 layers divided by 255. Throws
  /// globe::Error when a tile cannot be decoded.
  void read(std::string_view layer, int d, int level, int i0, int j0, int ni, int nj, float* out) const;

  /// The same for a uint8 layer, bytes as stored.
  void read(std::string_view layer, int d, int level, int i0, int j0, int ni, int nj,
            std::uint8_t* out) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace globe::planet
