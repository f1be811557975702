#include "globe/planet/inset_stack.h"

#include <algorithm>
#include <array>
#include <utility>

#include "globe/base/srgb.h"
#include "globe/planet/measure.h"
#include "globe/planet/tile_nodes.h"

namespace globe::planet {
namespace {

constexpr std::array<Channel, 3> kColors{Channel::kRed, Channel::kGreen, Channel::kBlue};

/// True when an inset's block holds a node of its level or a coarser one.
bool holds(const InsetInfo& inset, const Node& node) {
  return std::any_of(inset.blocks.begin(), inset.blocks.end(), [&](const InsetBlock& block) {
    return block.d == node.d && block.coarser(inset.level - node.level).holds(node.i, node.j);
  });
}

bool all_are(const std::vector<float>& weights, float value) {
  return std::all_of(weights.begin(), weights.end(), [=](float w) { return w == value; });
}

}  // namespace

std::size_t TileParts::bytes() const {
  std::size_t sum = base->bytes();
  for (const InsetTile& tile : insets)
    sum += sizeof(InsetTile) + sizeof(float) * tile.weight.values.capacity() + tile.ground.bytes();
  return sum;
}

InsetStack::InsetStack(std::shared_ptr<const Dataset> dataset, const Synthesis& below)
    : dataset_(std::move(dataset)) {
  if (dataset_ == nullptr) return;
  for (const InsetInfo& info : dataset_->info().insets) {
    Synthesis synthesis = below;
    synthesis.data_level = info.level;
    const bool has_heights = info.layer == "height";
    insets_.push_back({info, synthesis, has_heights});
    if (has_heights) finest_level_ = std::max(finest_level_, info.level);
  }
}

bool InsetStack::touches(const Inset& inset, const TileId& id) const {
  const int n = nodes_per_side(id.level);
  const int i0 = id.first_i() - kTileGuard, i1 = id.first_i() + id.cells() + kTileGuard;
  const int j0 = id.first_j() - kTileGuard, j1 = id.first_j() + id.cells() + kTileGuard;
  for (const InsetBlock& block : inset.info.blocks) {
    const InsetBlock nodes = block.coarser(inset.info.level - id.level);
    if (nodes.d == id.d && nodes.i0 <= i1 && nodes.i1 >= i0 && nodes.j0 <= j1 && nodes.j1 >= j0) return true;
  }
  if (i0 >= 0 && j0 >= 0 && i1 <= n && j1 <= n) return false;
  bool found = false;
  for_each_node(id, kTileGuard, [&](int i, int j, const Node& node) {
    if (i < 0 || j < 0 || i > n || j > n) found = found || holds(inset.info, node);
  });
  return found;
}

std::vector<float> InsetStack::read(std::size_t inset, const char* what, std::size_t channels,
                                    const TileId& id, int guard) const {
  return read_tile_nodes(id, guard, channels,
                         [&](int d, int level, int i0, int j0, int ni, int nj, float* out) {
                           dataset_->read_inset(inset, what, d, level, i0, j0, ni, nj, out);
                         });
}

float InsetStack::read(std::size_t inset, const char* what, const Node& node) const {
  float value = 0.0f;
  dataset_->read_inset(inset, what, node.d, node.level, node.i, node.j, 1, 1, &value);
  return value;
}

InsetTile InsetStack::read_tile(std::size_t number, const TileId& id) const {
  const Inset& inset = insets_[number];
  InsetTile tile{number, TileValues<float>(id), SurfaceTile(id)};
  tile.weight.values = read(number, "weight", 1, id, kTileGuard);
  if (!inset.has_heights) {
    tile.ground.height.values.clear();
    const std::vector<float> colors = read(number, "color", 3, id, kTileGuard);
    for (std::size_t c = 0; c < kColors.size(); ++c) {
      TileValues<float>& channel = tile.ground.channel(kColors[c]);
      channel = TileValues<float>(id);
      for (std::size_t k = 0; k < channel.values.size(); ++k)
        channel.values[k] = linear_from_srgb(colors[3 * k + c]);
    }
    return tile;
  }
  const auto as_heights = [&](const std::vector<float>& samples, int guard) {
    TileValues<double> values(id, 0.0, guard);
    std::copy(samples.begin(), samples.end(), values.values.begin());
    return values;
  };
  tile.ground.height = as_heights(read(number, "height", 1, id, kTileGuard), kTileGuard);
  if (id.level < inset.info.level)
    tile.ground.relief = as_heights(read(number, "relief", 1, id, kTileGuard), kTileGuard);
  if (id.level == inset.info.level) {
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (inset.synthesis.has_channel(static_cast<Channel>(c), id.level))
        tile.ground.channels[c] = TileValues<float>(id);
    }
    constexpr int kReach = kTileGuard + kMeasureMargin;
    measure_ground(
        inset.synthesis, as_heights(read(number, "height", 1, id, kReach), kReach),
        [&](const Node& node) { return static_cast<double>(read(number, "height", node)); }, tile.ground);
  }
  return tile;
}

InsetTile InsetStack::child(const InsetTile& parent, const TileId& id) const {
  const Synthesis& synthesis = insets_[parent.inset].synthesis;
  InsetTile tile{parent.inset, TileValues<float>(id), SurfaceTile(id)};
  predict(parent.weight, tile.weight);
  for (float& w : tile.weight.values) w = std::clamp(w, 0.0f, 1.0f);
  const bool has_heights = insets_[parent.inset].has_heights;
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (parent.ground.channels[c].values.empty()) continue;
    if (has_heights && !synthesis.has_channel(static_cast<Channel>(c), id.level)) continue;
    tile.ground.channels[c] = TileValues<float>(id);
    predict(parent.ground.channels[c], tile.ground.channels[c]);
  }
  if (has_heights) {
    predict(parent.ground.height, tile.ground.height);
    synthesise_detail(synthesis, false, tile.ground);
  } else {
    tile.ground.height.values.clear();
  }
  return tile;
}

std::vector<InsetTile> InsetStack::tiles(const TileId& id, const TileParts* parent) const {
  std::vector<InsetTile> found;
  for (std::size_t k = 0; k < insets_.size(); ++k) {
    if (id.level <= insets_[k].info.level) {
      if (!touches(insets_[k], id)) continue;
      found.push_back(read_tile(k, id));
    } else {
      if (parent == nullptr) continue;
      const auto from = std::find_if(parent->insets.begin(), parent->insets.end(),
                                     [&](const InsetTile& tile) { return tile.inset == k; });
      if (from == parent->insets.end()) continue;
      found.push_back(child(*from, id));
    }
    if (id.level >= insets_[k].info.level && all_are(found.back().weight.values, 0.0f)) found.pop_back();
  }
  const auto topmost = std::find_if(found.rbegin(), found.rend(),
                                    [&](const InsetTile& tile) { return hides_all_below(tile); });
  if (topmost != found.rend()) {
    const std::size_t covering = topmost->inset;
    std::erase_if(found, [&](const InsetTile& tile) {
      return tile.inset < covering && insets_[tile.inset].has_heights;
    });
  }
  return found;
}

bool InsetStack::hides_all_below(const InsetTile& tile) const {
  const Inset& inset = insets_[tile.inset];
  return inset.has_heights && tile.weight.id.level >= inset.info.level && all_are(tile.weight.values, 1.0f);
}

bool InsetStack::hide_base(const std::vector<InsetTile>& tiles) const {
  return std::any_of(tiles.begin(), tiles.end(),
                     [&](const InsetTile& tile) { return hides_all_below(tile); });
}

SurfaceTile InsetStack::put_together(const SurfaceTile& base, const std::vector<InsetTile>& tiles) const {
  const TileId id = base.id;
  SurfaceTile whole(id);
  const auto take = [&](Channel c) { whole.channel(c) = base.channel(c); };
  for (const Channel c : kColors) take(c);
  for (const Channel c : {Channel::kMoisture, Channel::kRoughness, Channel::kProminence, Channel::kMottle})
    take(c);
  if (!base.height.values.empty()) whole.height = base.height;
  const bool filtered = base.relief || std::any_of(tiles.begin(), tiles.end(), [](const InsetTile& tile) {
                          return tile.ground.relief.has_value();
                        });
  if (filtered) whole.relief = base.height.values.empty() ? TileValues<double>(id) : base.shading_height();
  for (const InsetTile& tile : tiles) {
    const auto lay = [&](auto& below, auto above) {
      using T = std::remove_reference_t<decltype(below[0])>;
      for (std::size_t k = 0; k < below.size(); ++k)
        below[k] = static_cast<T>(laid_over(below[k], above(k), static_cast<double>(tile.weight.values[k])));
    };
    const auto lay_channel = [&](Channel c) {
      const std::vector<float>& above = tile.ground.channel(c).values;
      lay(whole.channel(c).values,
          [&](std::size_t k) { return above.empty() ? 0.0 : static_cast<double>(above[k]); });
    };
    if (insets_[tile.inset].has_heights) {
      lay(whole.height.values, [&](std::size_t k) { return tile.ground.height.values[k]; });
      if (whole.relief)
        lay(whole.relief->values, [&](std::size_t k) { return tile.ground.shading_height().values[k]; });
      if (whole.channel(Channel::kRoughness).values.empty() && id.level >= insets_[tile.inset].info.level) {
        whole.channel(Channel::kRoughness) = TileValues<float>(id);
        whole.channel(Channel::kProminence) = TileValues<float>(id);
      }
      lay_channel(Channel::kRoughness);
      lay_channel(Channel::kProminence);
    } else {
      for (const Channel c : kColors) lay_channel(c);
    }
  }
  return whole;
}

double InsetStack::data_height(std::size_t k, const Node& node, double below) const {
  const Inset& inset = insets_[k];
  if (node.level <= inset.info.level) {
    if (!holds(inset.info, node)) return below;
    const double w = static_cast<double>(read(k, "weight", node));
    return w > 0.0 ? laid_over(below, static_cast<double>(read(k, "height", node)), w) : below;
  }
  const WeightedNodes around = trixel_nodes(node, inset.info.level);
  if (!std::any_of(around.nodes.begin(), around.nodes.end(),
                   [&](const Node& corner) { return holds(inset.info, corner); }))
    return below;
  const double w =
      around.sum([&](const Node& corner) { return static_cast<double>(read(k, "weight", corner)); });
  if (w <= 0.0) return below;
  const double above =
      around.sum([&](const Node& corner) { return static_cast<double>(read(k, "height", corner)); });
  return laid_over(below, above, w);
}

double InsetStack::data_height(const Node& node, double below) const {
  for (std::size_t k = 0; k < insets_.size(); ++k)
    if (insets_[k].has_heights) below = data_height(k, node, below);
  return below;
}

void InsetStack::lay_data_heights(int d, int level, int i0, int j0, int ni, int nj, double* heights) const {
  const auto count = static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj);
  std::vector<float> weight(count), height(count);
  for (std::size_t k = 0; k < insets_.size(); ++k) {
    const Inset& inset = insets_[k];
    if (!inset.has_heights) continue;
    if (level > inset.info.level) {
      double* at = heights;
      for (int j = j0; j < j0 + nj; ++j)
        for (int i = i0; i < i0 + ni; ++i, ++at) *at = data_height(k, {d, level, i, j}, *at);
      continue;
    }
    dataset_->read_inset(k, "weight", d, level, i0, j0, ni, nj, weight.data());
    if (all_are(weight, 0.0f)) continue;
    dataset_->read_inset(k, "height", d, level, i0, j0, ni, nj, height.data());
    for (std::size_t at = 0; at < count; ++at)
      heights[at] = laid_over(heights[at], static_cast<double>(height[at]), static_cast<double>(weight[at]));
  }
}

InsetStack::DataAt InsetStack::data_at(const dvec3& u, std::string_view layer) const {
  DataAt found;
  for (std::size_t k = insets_.size(); k-- > 0 && !found.alone;) {
    const Inset& inset = insets_[k];
    if (inset.info.layer != layer) continue;
    const Place place = locate(u, inset.info.level);
    const WeightedNodes around = trixel_nodes(place.d, inset.info.level, place.ij);
    if (!std::any_of(around.nodes.begin(), around.nodes.end(),
                     [&](const Node& corner) { return holds(inset.info, corner); }))
      continue;
    std::array<float, 3> weights{};
    std::transform(around.nodes.begin(), around.nodes.end(), weights.begin(),
                   [&](const Node& corner) { return read(k, "weight", corner); });
    const auto [least, most] = std::minmax_element(weights.begin(), weights.end());
    if (*most <= 0.0f) continue;
    if (!found.inset) found.inset = k;
    found.level = std::max(found.level, inset.info.level);
    found.alone = *least >= 1.0f;
  }
  return found;
}

std::optional<double> InsetStack::highest() const {
  std::optional<double> found;
  for (const Inset& inset : insets_)
    if (inset.has_heights) found = std::max(found.value_or(inset.info.max), inset.info.max);
  return found;
}

std::optional<double> InsetStack::highest(int d, int level, int i, int j) const {
  std::optional<double> found;
  for (const Inset& inset : insets_) {
    if (!inset.has_heights) continue;
    const bool touched =
        std::any_of(inset.info.blocks.begin(), inset.info.blocks.end(), [&](const InsetBlock& b) {
          const int down = inset.info.level - level;
          if (b.d != d) return false;
          if (down < 0) {
            const int up = -down;
            return (i >> up) <= b.i1 && (i >> up) + 1 >= b.i0 && (j >> up) <= b.j1 && (j >> up) + 1 >= b.j0;
          }
          return (static_cast<std::int64_t>(i) << down) <= b.i1 &&
                 (static_cast<std::int64_t>(i + 1) << down) >= b.i0 &&
                 (static_cast<std::int64_t>(j) << down) <= b.j1 &&
                 (static_cast<std::int64_t>(j + 1) << down) >= b.j0;
        });
    if (touched) found = std::max(found.value_or(inset.info.max), inset.info.max);
  }
  return found;
}

}  // namespace globe::planet
