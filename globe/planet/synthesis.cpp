#include "globe/planet/synthesis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "globe/planet/directions.h"

namespace globe::planet {
namespace {

constexpr double kFinestValley = 75.0;  ///< metres
constexpr double kFinestCrater = 20.0;

constexpr double kNodesPerWave = 3.9;  ///< carving stops where the finest wave has as many

/// Uniform in [-1, 1) from the top bits of a hash.
double signed_unit(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-52 - 1.0; }

constexpr std::uint64_t kSecond = 0x9e3779b97f4a7c15ULL;  ///< a second number from a node's hash
constexpr std::uint64_t kThird = 0xd1342543de82ef95ULL;

bool is_new(const Node& node) { return ((node.i | node.j) & 1) != 0 || node.level == 0; }

}  // namespace

double Synthesis::edge_m(int level) const { return std::ldexp(root_edge, -level); }

double Synthesis::finest_wave_m() const { return craters ? kFinestCrater : kFinestValley; }

int Synthesis::carved_level() const {
  int level = data_level;
  while (edge_m(level) * kNodesPerWave > finest_wave_m()) ++level;
  return level;
}

ReliefScale Synthesis::relief_scale() const {
  return {static_cast<std::uint32_t>(vertex_hash(seed, {1, 0, 0}) >> 32), root_edge / 1.5707963267948966,
          edge_m(data_level), finest_wave_m(), craters};
}

bool Synthesis::has_channel(Channel channel, int level) const {
  switch (channel) {
    case Channel::kCarved:
    case Channel::kSlopeX:
    case Channel::kSlopeY:
    case Channel::kSlopeZ:
      return level >= data_level && level <= carved_level() && carved_level() > data_level;
    case Channel::kRoughness:
    case Channel::kProminence:
      return level >= data_level;
    default:
      return false;
  }
}

namespace {

/// New nodes of a level that is still carved.
void carve(const Synthesis& synthesis, bool own_nodes_only, SurfaceTile& tile) {
  const ReliefScale scale = synthesis.relief_scale();
  const TileValues<dvec3> directions = node_directions(tile.id);
  const bool last = tile.id.level == synthesis.carved_level();
  TileValues<float>& carved = tile.channel(Channel::kCarved);
  TileValues<float>& roughness = tile.channel(Channel::kRoughness);
  std::vector<ivec2> nodes;
  nodes.reserve(directions.values.size());
  for_each_node(tile.id, guard_of(own_nodes_only), [&](int i, int j, const Node& node) {
    if (last || is_new(node)) nodes.emplace_back(i, j);
  });
  const auto slope = [&](std::size_t at) {
    return vec3(tile.channel(Channel::kSlopeX).values[at], tile.channel(Channel::kSlopeY).values[at],
                tile.channel(Channel::kSlopeZ).values[at]);
  };
  const auto set = [&](const ivec2& node, std::size_t k, ReliefPlaces& places) {
    const std::size_t at = carved.index(node.x, node.y);
    places.set(k, directions.values[at], std::clamp(roughness.values[at], 0.0f, 1.0f), slope(at));
  };
  const auto make = [&](const ReliefPlaces& places) { return carved_relief(scale, places); };
  const auto get = [&](const ivec2& node, std::size_t k, const ReliefLanes& r) {
    const std::size_t at = carved.index(node.x, node.y);
    if (is_new({tile.id.d, tile.id.level, node.x, node.y})) {
      tile.height.values[at] += static_cast<double>(r.height_m[k]) - static_cast<double>(carved.values[at]);
      carved.values[at] = r.height_m[k];
      tile.channel(Channel::kProminence).values[at] = r.prominence[k];
    }
    if (last) {
      // From here on roughness is that of the slope the node lies on: flat floors stay smooth.
      const float steep = glm::length(slope(at) + vec3(r.slope_x[k], r.slope_y[k], r.slope_z[k]));
      roughness.values[at] = std::min(1.0f, roughness.values[at] * 0.25f + 1.4f * steep);
    }
  };
  in_lanes(nodes, set, make, get);
}

/// New nodes below the last carved level, displaced by their hash: half the slope at every third level below
/// some 50 m, so that ground at eye height undulates gently.
void displace(const Synthesis& synthesis, bool own_nodes_only, SurfaceTile& tile) {
  const double edge = synthesis.edge_m(tile.id.level);
  const double slope = 0.15 * std::sqrt(edge / (edge + 25.0));
  TileValues<float>& roughness = tile.channel(Channel::kRoughness);
  TileValues<float>& prominence = tile.channel(Channel::kProminence);
  for_each_node(tile.id, guard_of(own_nodes_only), [&](int i, int j, const Node& node) {
    if (!is_new(node)) return;
    const std::uint64_t hash = vertex_hash(synthesis.seed, octahedral_key(node));
    const double push = signed_unit(hash);
    const double rough = std::clamp(roughness.at(i, j), 0.0f, 1.0f);
    const double calm = rough / (rough + 0.004);  // still water stays still
    const double crest = 0.65 + 0.45 * static_cast<double>(prominence.at(i, j));
    tile.height.at(i, j) += edge * slope * calm * (0.2 + rough) * std::max(0.15, crest) * push;
    prominence.at(i, j) =
        std::clamp(0.85f * prominence.at(i, j) + 0.3f * static_cast<float>(push), -1.0f, 1.0f);
    roughness.at(i, j) *= 1.0f + 0.3f * static_cast<float>(signed_unit(hash * kThird));
  });
}

}  // namespace

void synthesise_detail(const Synthesis& synthesis, bool own_nodes_only, SurfaceTile& tile) {
  if (tile.id.level <= synthesis.carved_level()) {
    carve(synthesis, own_nodes_only, tile);
  } else {
    displace(synthesis, own_nodes_only, tile);
  }
}

void synthesise_builtin(const BuiltinPlanet& planet, bool own_nodes_only, SurfaceTile& tile) {
  const TileValues<dvec3> directions = node_directions(tile.id);
  std::vector<std::size_t> nodes;
  std::vector<dvec3> u;
  for_each_node(tile.id, guard_of(own_nodes_only), [&](int i, int j, const Node& node) {
    if (!is_new(node)) return;
    nodes.push_back(tile.height.index(i, j));
    u.push_back(directions.at(i, j));
  });
  const std::vector<BuiltinPlanet::Point> points = planet.at(u);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    tile.height.values[nodes[k]] = points[k].height_m;
    tile.channel(Channel::kMoisture).values[nodes[k]] = points[k].moisture;
  }
}

void synthesise_mottle(std::uint64_t seed, bool own_nodes_only, SurfaceTile& tile) {
  TileValues<float>& mottle = tile.channel(Channel::kMottle);
  for_each_node(tile.id, guard_of(own_nodes_only), [&](int i, int j, const Node& node) {
    if (!is_new(node)) return;
    const std::uint64_t hash = vertex_hash(seed, octahedral_key(node));
    mottle.at(i, j) = 0.88f * mottle.at(i, j) + 0.26f * static_cast<float>(signed_unit(hash * kSecond));
  });
}

}  // namespace globe::planet
