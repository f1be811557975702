#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/planet/builtin_planet.h"
#include "globe/planet/dataset.h"
#include "globe/planet/subdivision.h"

namespace globe::planet {

/// What a tile carries beside heights, one float a node. All are carried from level to level by the same
/// stencil.
enum class Channel {
  kRed,  ///< ground colour of the map in linear light, [0, 1]
  kGreen,
  kBlue,
  kMoisture,    ///< built-in planet only: 0 desert, 1 rain forest
  kRoughness,   ///< how rough synthesised ground is here: 0 still water, 1 high mountains
  kProminence,  ///< about [-1, 1]: -1 on a valley floor, 1 on a crest of the ground below the data
  kMottle,      ///< a fractal without a unit that varies colours, about [-1, 1]
  kCarved,      ///< carved ground that `height` holds, metres; only down to the last carved level
  kSlopeX,      ///< rise over run of the ground carving starts from, a tangent vector; as far as kCarved
  kSlopeY,
  kSlopeZ,
};
inline constexpr std::size_t kChannels = 11;

/// How ground under a sea is drawn: as the sea's flat surface, or bare, for a sea that is drawn over it.
enum class SeaFloor { kFlooded, kBare };

/// No sea drawn over a bare floor stands farther from height 0 than this, metres.
inline constexpr double kHighestWave = 40.0;

class InsetStack;
struct Synthesis;
struct TileParts;

/// Everything known about the nodes of one tile. Immutable once made.
struct SurfaceTile {
  TileId id;
  TileValues<double> height;  ///< metres above the ellipsoid
  /// Heights filtered to this level, for slopes; empty when the same as `height` (from the data's finest
  /// level on).
  std::optional<TileValues<double>> relief;
  std::array<TileValues<float>, kChannels> channels;  ///< those not in use have no values
  /// What it is put together from, where insets touch it; else null. Such tiles lack the channels from
  /// kCarved on, which their parts have.
  std::shared_ptr<const TileParts> parts;

  explicit SurfaceTile(const TileId& tile);

  const TileValues<float>& channel(Channel c) const { return channels[static_cast<std::size_t>(c)]; }
  TileValues<float>& channel(Channel c) { return channels[static_cast<std::size_t>(c)]; }
  /// 0 where the channel is not in use.
  float value(Channel c, int i, int j) const {
    const TileValues<float>& values = channel(c);
    return values.values.empty() ? 0.0f : values.at(i, j);
  }
  std::size_t bytes() const;
  const TileValues<double>& shading_height() const { return relief ? *relief : height; }
};

/// Where the height of a place comes from.
struct DataSource {
  int level = 0;             ///< finest level of the data there
  std::string_view inset{};  ///< name of the topmost inset there; empty where there is none
  bool inset_alone = false;  ///< the planet's own data have no say
};

/// The ground of a planet at any node and any level: data where there are data, synthesised below them;
/// insets laid over both (inset_stack.h).
///
/// Height is a function of the node alone. Tiles are made from their parents and kept in a cache of limited
/// size, least recently used out first; every member is safe to call from any thread.
class Surface {
 public:
  /// The built-in planet.
  /// @param exaggeration  of the ground where it is drawn (drawn_height), >= 0; other heights stay true
  static std::shared_ptr<const Surface> builtin(std::uint64_t seed, std::size_t cache_bytes = kDefaultCache,
                                                double exaggeration = 1.0,
                                                SeaFloor sea_floor = SeaFloor::kFlooded);
  /// A planet made by `globe convert`.
  static std::shared_ptr<const Surface> from_dataset(std::shared_ptr<const Dataset> dataset,
                                                     std::size_t cache_bytes = kDefaultCache,
                                                     double exaggeration = 1.0,
                                                     SeaFloor sea_floor = SeaFloor::kFlooded);

  static constexpr std::size_t kDefaultCache = std::size_t{384} << 20;

  std::shared_ptr<const SurfaceTile> tile(const TileId& id) const;

  /// Height of a node, metres above the ellipsoid; down to the data level it costs no tile.
  double height(const Node& node) const;
  /// Height of a node by the data alone: below the level of the planet's data, or an inset's, these are
  /// linear in their trixels. The same as height(node) down to the data level. REQUIRES: has_data().
  double data_height(const Node& node) const;
  /// Height of a node of the data level or a coarser one by the planet's own data, as though it had no insets
  /// (built-in planet: by its own function).
  double own_height(const Node& node) const;
  /// data_height of nodes i0 .. i0+ni-1, j0 .. j0+nj-1 of a diamond, row by row; cheaper than one by one.
  void data_heights(int d, int level, int i0, int j0, int ni, int nj, double* out) const;
  /// The finest data at a place: data_level() but where there are insets.
  DataSource data_at(const dvec3& u) const;
  /// True where a height of the level, at most the data's, leans on a node that no map had a value for. Known
  /// of planets with a layer "void" only.
  bool is_filled(const dvec3& u, int level) const;
  /// Finest level of the colors there; -1 without any.
  int color_level_at(const dvec3& u) const;
  /// Height of the flat level-L trixel above a direction: linear between its three nodes.
  double height(const dvec3& u, int level) const;
  /// The same at the finest level up to `level` whose ground is known already: nothing is synthesised, so it
  /// takes microseconds. For what must not wait.
  double height_at_hand(const dvec3& u, int level) const;

  const PlanetInfo& info() const { return info_; }
  /// What the planet was made from; null for the built-in planet.
  const Dataset* dataset() const { return dataset_.get(); }
  const geo::Ellipsoid& ellipsoid() const { return info_.ellipsoid; }
  /// Finest level with measured heights of the whole planet (built-in planet: with its own function); what is
  /// finer is synthesised, but where there are insets.
  int data_level() const { return data_level_; }
  /// Finest level of any data, insets included.
  int finest_data_level() const;
  /// Insets of heights or colors.
  const InsetStack& insets() const { return *insets_; }
  /// True for a planet made of maps; what the built-in planet has is all synthesised.
  bool has_data() const { return dataset_ != nullptr; }
  /// False for a planet made of a colour map alone, whose ground is at height 0 down to level 0.
  bool has_heights() const { return dataset_ == nullptr || dataset_->layer("height") != nullptr; }
  bool has_colors() const { return color_level_ >= 0; }
  /// True when ground below height 0 lies under a sea, which is then drawn as a flat surface at height 0.
  bool is_airless() const { return info_.body == "moon"; }
  bool has_sea() const { return dataset_ == nullptr || info_.body == "earth"; }
  /// The ground below height 0 is drawn itself, for a sea that is drawn over it.
  SeaFloor sea_floor() const { return sea_floor_; }
  bool has_bare_floor() const { return has_sea() && sea_floor_ == SeaFloor::kBare; }
  /// Height at which ground of a height is drawn: at 0 where it lies under a sea.
  double drawn_height(double height_m) const {
    return has_sea() && height_m < 0.0 ? 0.0 : height_m * exaggeration_;
  }
  /// The same of the ground's mesh, which is the sea's floor where that is bare.
  double mesh_height(double height_m) const {
    return has_bare_floor() ? height_m * exaggeration_ : drawn_height(height_m);
  }
  double exaggeration() const { return exaggeration_; }
  /// That tiles are kept in.
  std::size_t cache_bytes() const { return cache_bytes_; }
  /// Length of a level-0 edge along the mean sphere, metres; a level-L edge is about 2^-L of it.
  double root_edge() const;

  ~Surface();

 private:
  Surface(PlanetInfo info, std::shared_ptr<const Dataset> dataset, std::uint64_t seed,
          std::size_t cache_bytes, double exaggeration, SeaFloor sea_floor);

  struct Entry {
    TileId id;
    std::shared_ptr<const SurfaceTile> tile;
  };
  struct TileHash {
    std::size_t operator()(const TileId& id) const;
  };

  std::shared_ptr<const SurfaceTile> make_tile(const TileId& id) const;
  /// The ground without insets; without heights and what goes with them when the parent lacks them or they
  /// are `hidden`.
  std::shared_ptr<const SurfaceTile> make_base(const SurfaceTile& parent, const TileId& id,
                                               bool hidden) const;
  /// The tile if it has been made and is still held, else null.
  std::shared_ptr<const SurfaceTile> tile_at_hand(const TileId& id) const;
  void make_roots() const;
  Synthesis synthesis() const;
  /// Channels that tiles of a level have.
  bool has_channel(Channel channel, int level) const;
  /// Channels that tiles of a level take over from their parents.
  bool inherits(Channel channel, int level) const;
  SurfaceTile empty_tile(const TileId& id) const;
  /// Fills data and synthesised detail into a predicted tile; `own_nodes_only` leaves the guard alone.
  void finish_tile(SurfaceTile& tile, bool own_nodes_only) const;
  void finish_heights(SurfaceTile& tile, bool own_nodes_only) const;
  void read_layer(const char* layer, SurfaceTile& tile, bool own_nodes_only) const;
  /// A layer's samples at the nodes of a tile and `guard` nodes beyond, row by row.
  std::vector<float> read_nodes(const char* layer, const TileId& id, int guard) const;
  /// Heights of the data around a tile whose own are known as far as `known` nodes beyond it.
  TileValues<double> heights_around(const SurfaceTile& tile, int known) const;

  PlanetInfo info_;
  std::shared_ptr<const Dataset> dataset_;  ///< null for the built-in planet
  std::uint64_t seed_;
  double exaggeration_;
  SeaFloor sea_floor_;
  std::optional<BuiltinPlanet> builtin_;  ///< where there is no data set
  std::unique_ptr<const InsetStack> insets_;
  int data_level_ = 0;
  int color_level_ = -1;
  mutable std::once_flag roots_made_;
  mutable std::array<std::array<std::shared_ptr<const SurfaceTile>, kDiamonds>, 7>
      roots_;  ///< levels 0 to 6, made at the first need of a tile, then held

  std::size_t cache_bytes_;
  mutable std::mutex mutex_;
  mutable std::size_t held_bytes_ = 0;  ///< by the tiles of cache_
  mutable std::list<Entry> recent_;     ///< most recently used first
  mutable std::unordered_map<TileId, std::list<Entry>::iterator, TileHash> cache_;
};

}  // namespace globe::planet
