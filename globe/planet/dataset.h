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
/// - "height": metres above the vertical datum, one channel, fp32. Coarser levels by sub-sampling: a coarse
///   sample *is* a fine sample.
///   @approximation storage.heights
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
/// - "void": one channel, 1 where no map had a height for the node, which was filled from around it; else 0.
/// The level of "height", coarser levels by sub-sampling. Only planets that were converted so have it.
struct LayerInfo {
  std::string name;
  int level = 0;
  int channels = 1;
  std::string storage = "float32";  ///< on disk: "float32" or "uint8"
  double min = 0;                   ///< of all samples, in the unit that Dataset::read gives as float
  double max = 0;

  friend bool operator==(const LayerInfo&, const LayerInfo&) = default;
};

/// A rectangle of nodes of one diamond, both ends included; empty when i1 < i0 or j1 < j0.
struct InsetBlock {
  int d = 0;
  int i0 = 0, i1 = -1;
  int j0 = 0, j1 = -1;

  bool empty() const { return i1 < i0 || j1 < j0; }
  bool holds(int i, int j) const { return i >= i0 && i <= i1 && j >= j0 && j <= j1; }
  /// The nodes of a level `steps` coarser that lie in it.
  InsetBlock coarser(int steps) const {
    const auto up = [&](int x) { return (x + (1 << steps) - 1) >> steps; };
    return {d, up(i0), i1 >> steps, up(j0), j1 >> steps};
  }

  friend bool operator==(const InsetBlock&, const InsetBlock&) = default;
};

/// Finer local data, laid over a layer of the planet: at most one block a diamond. Every level down to 0 of
/// its nodes is there, coarser ones by sub-sampling.
///
/// With w its weight, what lies below it counts 1 - w and itself w; w is 0 outside the blocks, and nodes that
/// diamonds share have the same samples in each. Samples that Dataset::read_inset gives:
/// - "weight": 0 to 1.
/// - "height": metres above the planet's vertical datum; means something where the weight is above 0 and up
///   to kInsetMargin nodes beyond.
/// - "relief": the same heights filtered, at levels coarser than the inset's, where the weight is above 0.
/// - "color": three channels of sRGB, coarser levels filtered.
struct InsetInfo {
  std::string name;
  std::string layer;  ///< what it is laid over: "height" (then it has height, weight, relief), or "color"
                      ///< (color, weight)
  int level = 0;      ///< not coarser than the layer's, nor than kCoarsestInset
  double min = 0;     ///< of the samples with a weight, in the unit that read_inset gives
  double max = 0;
  std::vector<InsetBlock> blocks;  ///< at `level`

  friend bool operator==(const InsetInfo&, const InsetInfo&) = default;
};

inline constexpr int kCoarsestInset = 7;
inline constexpr int kInsetMargin = 8;

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
  std::vector<InsetInfo> insets = {};  ///< later ones lie over earlier ones

  friend bool operator==(const PlanetInfo&, const PlanetInfo&) = default;
};

/// Which of a planet's layers are opened; those left out are as good as not there.
struct LayerChoice {
  bool heights = true;  ///< "height" and what comes of it
  bool colors = true;
  bool insets = true;  ///< of the layers above
};

/// A planet on disk: a folder with planet.json and, per layer and diamond, one tiled TIFF. Samples come
/// through a cache of decoded tiles, so a planet may be larger than memory. Copies share the cache; reading
/// is thread-safe.
class Dataset {
 public:
  /// Opens the planet and checks that every file is whole (size, header, levels); `cache_bytes` caps the
  /// decoded tiles kept. Throws globe::Error with one line when there is no planet.json, it is broken or of a
  /// newer format, or a file is missing, truncated or not what planet.json says.
  static Dataset open(const std::filesystem::path& folder, std::size_t cache_bytes,
                      const LayerChoice& layers = {});

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

  /// Nodes of inset number `inset` of info(), at its level or a coarser one; 0 outside its blocks. `what` and
  /// the samples: see InsetInfo; order as for read().
  void read_inset(std::size_t inset, std::string_view what, int d, int level, int i0, int j0, int ni, int nj,
                  float* out) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace globe::planet
