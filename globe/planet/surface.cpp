#include "globe/planet/surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "globe/planet/directions.h"
#include "globe/planet/measure.h"
#include "globe/planet/synthesis.h"

namespace globe::planet {
namespace {

constexpr int kRootLevel = 6;  ///< 64 cells a side: the finest level that is one tile a diamond

int guard_of(bool own_nodes_only) { return own_nodes_only ? 0 : kTileGuard; }

/// Linear light of an sRGB value in [0, 1] (IEC 61966-2-1).
float linear_from_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

PlanetInfo builtin_info(std::uint64_t seed) {
  PlanetInfo info;
  info.name = "procedural:" + std::to_string(seed);
  info.body = "other";
  info.vertical_datum = "ellipsoid";
  return info;
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
  return sum;
}

std::size_t Surface::TileHash::operator()(const TileId& id) const {
  return static_cast<std::size_t>(
      vertex_hash(static_cast<std::uint64_t>(id.d * 64 + id.level), {id.ti, id.tj, 0}));
}

std::shared_ptr<const Surface> Surface::builtin(std::uint64_t seed, std::size_t cache_bytes) {
  return std::shared_ptr<const Surface>(new Surface(builtin_info(seed), nullptr, seed, cache_bytes));
}

std::shared_ptr<const Surface> Surface::from_dataset(std::shared_ptr<const Dataset> dataset,
                                                     std::size_t cache_bytes) {
  PlanetInfo info = dataset->info();
  return std::shared_ptr<const Surface>(new Surface(std::move(info), std::move(dataset), 1, cache_bytes));
}

Surface::Surface(PlanetInfo info, std::shared_ptr<const Dataset> dataset, std::uint64_t seed,
                 std::size_t cache_bytes)
    : info_(std::move(info)), dataset_(std::move(dataset)), seed_(seed), cache_bytes_(cache_bytes) {
  if (dataset_) {
    const LayerInfo* heights = dataset_->layer("height");
    const LayerInfo* colors = dataset_->layer("color");
    data_level_ = heights ? heights->level : 0;
    color_level_ = colors ? colors->level : -1;
  } else {
    builtin_.emplace(seed);
    data_level_ = kBuiltinLevel;
  }
}

double Surface::root_edge() const { return ellipsoid().mean_radius() * std::numbers::pi / 2.0; }

void Surface::make_roots() const {
  for (int level = 0; level <= kRootLevel; ++level) {
    std::vector<SurfaceTile> tiles;
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
  auto child = std::make_shared<SurfaceTile>(empty_tile(id));
  predict(parent->height, child->height);
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (inherits(static_cast<Channel>(c), id.level)) predict(parent->channels[c], child->channels[c]);
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
    case Channel::kCarved:
    case Channel::kSlopeX:
    case Channel::kSlopeY:
    case Channel::kSlopeZ:
      return level >= data_level_ && level <= synthesis().carved_level() &&
             synthesis().carved_level() > data_level_;
    case Channel::kRoughness:
    case Channel::kProminence:
      return level >= data_level_;
    case Channel::kMottle:
      return true;
  }
  return true;
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
        [this](const Node& node) { return measured_height(node); }, tile);
  }
}

double Surface::measured_height(const Node& node) const {
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
  } else {
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
  const int n = nodes_per_side(id.level);
  const auto channels = static_cast<std::size_t>(dataset_->layer(layer)->channels);
  const int i0 = std::max(id.first_i() - guard, 0);
  const int i1 = std::min(id.first_i() + id.cells() + guard, n);
  const int j0 = std::max(id.first_j() - guard, 0);
  const int j1 = std::min(id.first_j() + id.cells() + guard, n);
  const auto row = static_cast<std::size_t>(i1 - i0 + 1) * channels;
  std::vector<float> own(row * static_cast<std::size_t>(j1 - j0 + 1));
  dataset_->read(layer, id.d, id.level, i0, j0, i1 - i0 + 1, j1 - j0 + 1, own.data());
  const auto stride = static_cast<std::size_t>(id.cells() + 1 + 2 * guard);
  if (own.size() == stride * stride * channels) return own;
  std::vector<float> values(stride * stride * channels);
  float* value = values.data();
  for_each_node(id, guard, [&](int i, int j, const Node& node) {
    if (i >= i0 && i <= i1 && j >= j0 && j <= j1) {
      const float* from =
          &own[static_cast<std::size_t>(j - j0) * row + static_cast<std::size_t>(i - i0) * channels];
      std::copy_n(from, channels, value);
    } else {
      dataset_->read(layer, node.d, node.level, node.i, node.j, 1, 1, value);
    }
    value += channels;
  });
  return values;
}

double Surface::height(const Node& node) const {
  if (node.level <= data_level_) return measured_height(node);
  return tile(tile_of(node))->height.at(node.i, node.j);
}

namespace {

/// The three nodes of the level's trixel that holds a place, and their weights in it.
struct Corners {
  std::array<Node, 3> nodes;
  std::array<double, 3> weights;
};

Corners corners_at(const dvec3& u, int level) {
  const Place place = locate(u, level);
  const int n = nodes_per_side(level);
  const int i = std::min(static_cast<int>(place.ij.x), n - 1);
  const int j = std::min(static_cast<int>(place.ij.y), n - 1);
  const double x = place.ij.x - i;
  const double y = place.ij.y - j;
  const auto at = [&](int di, int dj) { return Node{place.d, level, i + di, j + dj}; };
  if (x + y <= 1.0) return {{at(0, 0), at(1, 0), at(0, 1)}, {1.0 - x - y, x, y}};
  return {{at(1, 1), at(0, 1), at(1, 0)}, {x + y - 1.0, 1.0 - x, 1.0 - y}};
}

}  // namespace

double Surface::height(const dvec3& u, int level) const {
  const auto [nodes, weights] = corners_at(u, level);
  return weights[0] * height(nodes[0]) + weights[1] * height(nodes[1]) + weights[2] * height(nodes[2]);
}

double Surface::height_at_hand(const dvec3& u, int level) const {
  for (; level > std::max(data_level_, kRootLevel); --level) {
    const auto [nodes, weights] = corners_at(u, level);
    double sum = 0.0;
    bool known = true;
    for (std::size_t k = 0; known && k < nodes.size(); ++k) {
      const auto tile = tile_at_hand(tile_of(nodes[k]));
      known = tile != nullptr;
      if (known) sum += weights[k] * tile->height.at(nodes[k].i, nodes[k].j);
    }
    if (known) return sum;
  }
  return height(u, level);
}

}  // namespace globe::planet
