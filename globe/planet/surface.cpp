#include "globe/planet/surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "globe/base/srgb.h"
#include "globe/planet/directions.h"
#include "globe/planet/inset_stack.h"
#include "globe/planet/measure.h"
#include "globe/planet/synthesis.h"
#include "globe/planet/tile_nodes.h"

namespace globe::planet {
namespace {

constexpr int kRootLevel = 6;  ///< 64 cells a side: the finest level that is one tile a diamond

PlanetInfo builtin_info(std::uint64_t seed) {
  PlanetInfo info;
  info.name = "procedural:" + std::to_string(seed);
  info.body = "other";
  info.vertical_datum = "ellipsoid";
  return info;
}

std::shared_ptr<const SurfaceTile> with_insets(const InsetStack& stack,
                                               std::shared_ptr<const SurfaceTile> base,
                                               std::vector<InsetTile> tiles) {
  if (tiles.empty()) return base;
  auto whole = std::make_shared<SurfaceTile>(stack.put_together(*base, tiles));
  whole->parts = std::make_shared<const TileParts>(TileParts{std::move(base), std::move(tiles)});
  return whole;
}

/// True for channels that only heights have a use for.
bool goes_with_heights(Channel channel) {
  return channel == Channel::kRoughness || channel == Channel::kProminence || channel >= Channel::kCarved;
}

}  // namespace

SurfaceTile::SurfaceTile(const TileId& tile) : id(tile), height(tile) {
  for (TileValues<float>& channel : channels) {
    channel.id = tile;
    channel.values.clear();
  }
}

std::size_t SurfaceTile::bytes() const {
  std::size_t sum = sizeof(SurfaceTile) + sizeof(double) * height.values.capacity();
  if (relief) sum += sizeof(double) * relief->values.capacity();
  for (const TileValues<float>& channel : channels) sum += sizeof(float) * channel.values.capacity();
  if (parts) sum += parts->bytes();
  return sum;
}

std::size_t Surface::TileHash::operator()(const TileId& id) const {
  return static_cast<std::size_t>(
      vertex_hash(static_cast<std::uint64_t>(id.d * 64 + id.level), {id.ti, id.tj, 0}));
}

std::shared_ptr<const Surface> Surface::builtin(std::uint64_t seed, std::size_t cache_bytes,
                                                double exaggeration, SeaFloor sea_floor) {
  return std::shared_ptr<const Surface>(
      new Surface(builtin_info(seed), nullptr, seed, cache_bytes, exaggeration, sea_floor));
}

std::shared_ptr<const Surface> Surface::from_dataset(std::shared_ptr<const Dataset> dataset,
                                                     std::size_t cache_bytes, double exaggeration,
                                                     SeaFloor sea_floor) {
  PlanetInfo info = dataset->info();
  return std::shared_ptr<const Surface>(
      new Surface(std::move(info), std::move(dataset), 1, cache_bytes, exaggeration, sea_floor));
}

Surface::Surface(PlanetInfo info, std::shared_ptr<const Dataset> dataset, std::uint64_t seed,
                 std::size_t cache_bytes, double exaggeration, SeaFloor sea_floor)
    : info_(std::move(info)),
      dataset_(std::move(dataset)),
      seed_(seed),
      exaggeration_(exaggeration),
      sea_floor_(sea_floor),
      cache_bytes_(cache_bytes) {
  if (dataset_) {
    const LayerInfo* heights = dataset_->layer("height");
    const LayerInfo* colors = dataset_->layer("color");
    data_level_ = heights ? heights->level : 0;
    color_level_ = colors ? colors->level : -1;
  } else {
    builtin_.emplace(seed);
    data_level_ = kBuiltinLevel;
  }
  insets_ = std::make_unique<const InsetStack>(dataset_, synthesis());
}

Surface::~Surface() = default;

double Surface::root_edge() const { return ellipsoid().mean_radius() * std::numbers::pi / 2.0; }

void Surface::make_roots() const {
  for (int level = 0; level <= kRootLevel; ++level) {
    std::vector<SurfaceTile> tiles;
    tiles.reserve(kDiamonds);
    for (int d = 0; d < kDiamonds; ++d) tiles.push_back(empty_tile({d, level, 0, 0}));
    const auto each = [&](auto member, auto type) {
      using T = decltype(type);
      Whole<T> whole;
      for (std::size_t d = 0; d < kDiamonds; ++d) whole[d] = member(tiles[d]);
      if (level > 0) {
        Whole<T> parents;
        for (std::size_t d = 0; d < kDiamonds; ++d) {
          SurfaceTile parent = *roots_[static_cast<std::size_t>(level) - 1][d];
          parents[d] = member(parent);
        }
        predict(parents, whole);
      }
      for (std::size_t d = 0; d < kDiamonds; ++d) member(tiles[d]) = whole[d];
    };
    const auto fold_guard = [&](auto member, auto type) {
      Whole<decltype(type)> whole;
      for (std::size_t d = 0; d < kDiamonds; ++d) whole[d] = member(tiles[d]);
      fill_guard(whole);
      for (std::size_t d = 0; d < kDiamonds; ++d) member(tiles[d]) = whole[d];
    };
    const auto height = [](SurfaceTile & tile) -> auto& { return tile.height; };
    each(height, 0.0);
    const auto channel = [](std::size_t c) {
      return [c](SurfaceTile & tile) -> auto& { return tile.channels[c]; };
    };
    for (std::size_t c = 0; c < kChannels; ++c)
      if (inherits(static_cast<Channel>(c), level)) each(channel(c), 0.0f);
    for (SurfaceTile& tile : tiles) finish_tile(tile, true);
    fold_guard(height, 0.0);
    if (tiles[0].relief)
      fold_guard(
          [](SurfaceTile & tile) -> auto& { return *tile.relief; }, 0.0);
    for (std::size_t c = 0; c < kChannels; ++c)
      if (has_channel(static_cast<Channel>(c), level)) fold_guard(channel(c), 0.0f);
    for (std::size_t d = 0; d < kDiamonds; ++d) {
      roots_[static_cast<std::size_t>(level)][d] = std::make_shared<const SurfaceTile>(std::move(tiles[d]));
    }
  }
  for (auto& level : roots_) {
    for (auto& root : level) root = with_insets(*insets_, root, insets_->tiles(root->id, nullptr));
  }
}

std::shared_ptr<const SurfaceTile> Surface::tile_at_hand(const TileId& id) const {
  if (id.level <= kRootLevel)
    return roots_[static_cast<std::size_t>(id.level)][static_cast<std::size_t>(id.d)];
  const std::lock_guard lock(mutex_);
  const auto found = cache_.find(id);
  if (found == cache_.end()) return nullptr;
  recent_.splice(recent_.begin(), recent_, found->second);
  return found->second->tile;
}

std::shared_ptr<const SurfaceTile> Surface::tile(const TileId& id) const {
  std::call_once(roots_made_, [this] { make_roots(); });
  if (auto held = tile_at_hand(id)) return held;
  std::shared_ptr<const SurfaceTile> made = make_tile(id);
  const std::lock_guard lock(mutex_);
  if (const auto found = cache_.find(id); found != cache_.end()) return found->second->tile;
  recent_.push_front({id, made});
  cache_[id] = recent_.begin();
  held_bytes_ += made->bytes();
  while (cache_.size() > 64 && held_bytes_ > cache_bytes_) {
    held_bytes_ -= recent_.back().tile->bytes();
    cache_.erase(recent_.back().id);
    recent_.pop_back();
  }
  return made;
}

std::shared_ptr<const SurfaceTile> Surface::make_tile(const TileId& id) const {
  const std::shared_ptr<const SurfaceTile> parent = tile(id.parent());
  if (insets_->empty()) return make_base(*parent, id, false);
  std::vector<InsetTile> insets = insets_->tiles(id, parent->parts.get());
  const bool hidden = insets_->hide_base(insets);
  return with_insets(*insets_, make_base(parent->parts ? *parent->parts->base : *parent, id, hidden),
                     std::move(insets));
}

std::shared_ptr<const SurfaceTile> Surface::make_base(const SurfaceTile& parent, const TileId& id,
                                                      bool hidden) const {
  auto child = std::make_shared<SurfaceTile>(empty_tile(id));
  hidden = hidden || parent.height.values.empty();
  if (hidden) {
    child->height.values.clear();
    for (std::size_t c = 0; c < kChannels; ++c)
      if (goes_with_heights(static_cast<Channel>(c))) child->channels[c].values.clear();
  } else {
    predict(parent.height, child->height);
  }
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (!child->channels[c].values.empty() && inherits(static_cast<Channel>(c), id.level))
      predict(parent.channels[c], child->channels[c]);
  }
  finish_tile(*child, false);
  return child;
}

bool Surface::has_channel(Channel channel, int level) const {
  switch (channel) {
    case Channel::kRed:
    case Channel::kGreen:
    case Channel::kBlue:
      return has_colors();
    case Channel::kMoisture:
      return builtin_.has_value();
    case Channel::kMottle:
      return true;
    default:
      return synthesis().has_channel(channel, level);
  }
}

bool Surface::inherits(Channel channel, int level) const {
  return level > 0 && has_channel(channel, level) && has_channel(channel, level - 1);
}

SurfaceTile Surface::empty_tile(const TileId& id) const {
  SurfaceTile tile(id);
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (has_channel(static_cast<Channel>(c), id.level)) tile.channels[c] = TileValues<float>(id);
  }
  return tile;
}

Synthesis Surface::synthesis() const { return {seed_, root_edge(), data_level_, info_.body == "moon"}; }

void Surface::finish_tile(SurfaceTile& tile, bool own_nodes_only) const {
  const int level = tile.id.level;
  synthesise_mottle(seed_, own_nodes_only, tile);
  if (level <= color_level_) read_layer("color", tile, own_nodes_only);
  if (!tile.height.values.empty()) finish_heights(tile, own_nodes_only);
}

void Surface::finish_heights(SurfaceTile& tile, bool own_nodes_only) const {
  const int level = tile.id.level;
  if (level > data_level_) {
    synthesise_detail(synthesis(), own_nodes_only, tile);
    return;
  }
  if (builtin_) {
    synthesise_builtin(*builtin_, own_nodes_only, tile);
  } else if (has_heights()) {
    read_layer("height", tile, own_nodes_only);
    if (level < data_level_ && dataset_->layer("relief") != nullptr) {
      tile.relief.emplace(tile.id);
      read_layer("relief", tile, own_nodes_only);
    }
  }
  if (level == data_level_) {
    measure_ground(
        synthesis(), heights_around(tile, guard_of(own_nodes_only)),
        [this](const Node& node) { return own_height(node); }, tile);
  }
}

double Surface::own_height(const Node& node) const {
  if (builtin_) return builtin_->at(node_direction(node)).height_m;
  if (!has_heights()) return 0.0;
  float h = 0.0f;
  dataset_->read("height", node.d, node.level, node.i, node.j, 1, 1, &h);
  return static_cast<double>(h);
}

TileValues<double> Surface::heights_around(const SurfaceTile& tile, int known) const {
  TileValues<double> around(tile.id, 0.0, known + kMeasureMargin);
  if (builtin_) {
    const int cells = tile.id.cells();
    const auto held = [&](int x) { return x >= -known && x <= cells + known; };
    const TileValues<dvec3> directions = node_directions(tile.id, around.guard);
    std::vector<std::size_t> beyond;
    std::vector<dvec3> u;
    for_each_node(tile.id, around.guard, [&](int i, int j, const Node&) {
      if (held(i - tile.id.first_i()) && held(j - tile.id.first_j())) {
        around.at(i, j) = tile.height.at(i, j);
      } else {
        beyond.push_back(around.index(i, j));
        u.push_back(directions.at(i, j));
      }
    });
    const std::vector<BuiltinPlanet::Point> points = builtin_->at(u);
    for (std::size_t k = 0; k < beyond.size(); ++k) around.values[beyond[k]] = points[k].height_m;
  } else if (has_heights()) {
    const std::vector<float> heights = read_nodes("height", tile.id, around.guard);
    std::copy(heights.begin(), heights.end(), around.values.begin());
  }
  return around;
}

void Surface::read_layer(const char* layer, SurfaceTile& tile, bool own_nodes_only) const {
  const int guard = guard_of(own_nodes_only);
  const std::vector<float> values = read_nodes(layer, tile.id, guard);
  const auto channels = static_cast<std::size_t>(dataset_->layer(layer)->channels);
  const bool relief = std::strcmp(layer, "relief") == 0;
  const float* value = values.data();
  for_each_node(tile.id, guard, [&](int i, int j, const Node&) {
    if (channels == 3) {
      tile.channel(Channel::kRed).at(i, j) = linear_from_srgb(value[0]);
      tile.channel(Channel::kGreen).at(i, j) = linear_from_srgb(value[1]);
      tile.channel(Channel::kBlue).at(i, j) = linear_from_srgb(value[2]);
    } else {
      (relief ? *tile.relief : tile.height).at(i, j) = value[0];
    }
    value += channels;
  });
}

std::vector<float> Surface::read_nodes(const char* layer, const TileId& id, int guard) const {
  return read_tile_nodes(id, guard, static_cast<std::size_t>(dataset_->layer(layer)->channels),
                         [&](int d, int level, int i0, int j0, int ni, int nj, float* out) {
                           dataset_->read(layer, d, level, i0, j0, ni, nj, out);
                         });
}

double Surface::height(const Node& node) const {
  if (node.level <= data_level_) return insets_->data_height(node, own_height(node));
  return tile(tile_of(node))->height.at(node.i, node.j);
}

double Surface::data_height(const Node& node) const {
  const double own =
      node.level <= data_level_
          ? own_height(node)
          : trixel_nodes(node, data_level_).sum([&](const Node& corner) { return own_height(corner); });
  return insets_->data_height(node, own);
}

void Surface::data_heights(int d, int level, int i0, int j0, int ni, int nj, double* out) const {
  const int down = std::max(level - data_level_, 0);
  // The nodes of the planet's own data around them.
  const int last = nodes_per_side(level - down);
  const int c0 = i0 >> down, r0 = j0 >> down;
  const int nc = std::min(((i0 + ni - 1) >> down) + 1, last) - c0 + 1;
  const int nr = std::min(((j0 + nj - 1) >> down) + 1, last) - r0 + 1;
  std::vector<float> own(static_cast<std::size_t>(nc) * static_cast<std::size_t>(nr), 0.0f);
  if (has_heights()) dataset_->read("height", d, level - down, c0, r0, nc, nr, own.data());
  const auto at = [&](const Node& node) {
    return static_cast<double>(own[static_cast<std::size_t>(node.j - r0) * static_cast<std::size_t>(nc) +
                                   static_cast<std::size_t>(node.i - c0)]);
  };
  double* to = out;
  for (int j = j0; j < j0 + nj; ++j) {
    for (int i = i0; i < i0 + ni; ++i, ++to) {
      const Node node{d, level, i, j};
      *to = down == 0 ? at(node) : trixel_nodes(node, data_level_).sum(at);
    }
  }
  insets_->lay_data_heights(d, level, i0, j0, ni, nj, out);
}

DataSource Surface::data_at(const dvec3& u) const {
  const InsetStack::DataAt found = insets_->data_at(u, "height");
  if (!found.inset) return {data_level_, {}, false};
  return {std::max(found.level, data_level_), info_.insets[*found.inset].name, found.alone};
}

bool Surface::is_filled(const dvec3& u, int level) const {
  if (dataset_ == nullptr || dataset_->layer("void") == nullptr || insets_->data_at(u, "height").inset)
    return false;
  level = std::min(level, data_level_);
  const Place place = locate(u, level);
  return trixel_nodes(place.d, level, place.ij).sum([&](const Node& node) {
    float mark = 0.0f;
    dataset_->read("void", node.d, level, node.i, node.j, 1, 1, &mark);
    return static_cast<double>(mark);
  }) > 0.0;
}

int Surface::color_level_at(const dvec3& u) const {
  return std::max(color_level_, insets_->data_at(u, "color").level);
}

int Surface::finest_data_level() const { return std::max(data_level_, insets_->finest_level()); }

double Surface::height(const dvec3& u, int level) const {
  const Place place = locate(u, level);
  return trixel_nodes(place.d, level, place.ij).sum([&](const Node& node) { return height(node); });
}

double Surface::height_at_hand(const dvec3& u, int level) const {
  for (; level > std::max(data_level_, kRootLevel); --level) {
    const Place place = locate(u, level);
    bool known = true;
    const double sum = trixel_nodes(place.d, level, place.ij).sum([&](const Node& node) {
      const auto tile = tile_at_hand(tile_of(node));
      known = known && tile != nullptr;
      return tile != nullptr ? tile->height.at(node.i, node.j) : 0.0;
    });
    if (known) return sum;
  }
  return height(u, level);
}

}  // namespace globe::planet
