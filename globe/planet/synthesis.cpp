#include "globe/planet/synthesis.h"

#include <algorithm>
#include <cmath>

namespace globe::planet {
namespace {

constexpr int kBaseLevel = 9;  ///< the built-in planet's continents end here (cells of 20 km)

/// Uniform in [-1, 1) from the top bits of a hash.
double signed_unit(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-52 - 1.0; }

template <typename Visit>
void for_each_node(const TileId& id, bool own_nodes_only, const Visit& visit) {
  const int guard = own_nodes_only ? 0 : kTileGuard;
  const int n = nodes_per_side(id.level);
  for (int j = id.first_j() - guard; j <= id.first_j() + id.cells() + guard; ++j) {
    for (int i = id.first_i() - guard; i <= id.first_i() + id.cells() + guard; ++i) {
      const bool inside = i >= 0 && j >= 0 && i <= n && j <= n;
      visit(i, j, inside ? Node{id.d, id.level, i, j} : fold({id.d, id.level, i, j}));
    }
  }
}

}  // namespace

void synthesise_detail(std::uint64_t seed, double root_edge, int depth, bool own_nodes_only,
                       SurfaceTile& tile) {
  const double edge = std::ldexp(root_edge, -tile.id.level);
  static_cast<void>(depth);
  const double amplitude = 0.12 * edge * std::min(1.0, std::pow(edge / 200.0, 0.25));
  TileValues<float>& roughness = tile.channel(Channel::kRoughness);
  TileValues<float>& mottle = tile.channel(Channel::kMottle);
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    if (((node.i | node.j) & 1) == 0) return;
    const std::uint64_t hash = vertex_hash(seed, octahedral_key(node));
    tile.height.at(i, j) += amplitude * std::max(0.02f, roughness.at(i, j)) * signed_unit(hash);
    mottle.at(i, j) += static_cast<float>(0.25 * signed_unit(hash * 0x9e3779b97f4a7c15ULL));
  });
}

void synthesise_builtin(std::uint64_t seed, double root_edge, bool own_nodes_only, SurfaceTile& tile) {
  if (tile.id.level > kBaseLevel) {
    synthesise_detail(seed, root_edge, tile.id.level - kBaseLevel, own_nodes_only, tile);
    return;
  }
  const double scale = std::pow(0.55, tile.id.level);
  TileValues<float>& continent = tile.channel(Channel::kContinent);
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    if (((node.i | node.j) & 1) != 0 || tile.id.level == 0) {
      continent.at(i, j) += static_cast<float>(scale * signed_unit(vertex_hash(seed, octahedral_key(node))));
    }
    tile.height.at(i, j) = std::clamp(5000.0 * continent.at(i, j), -8000.0, 8000.0);
    tile.channel(Channel::kRoughness).at(i, j) = std::clamp(std::abs(continent.at(i, j)), 0.05f, 1.0f);
  });
}

void measure_roughness(double root_edge, SurfaceTile& tile) {
  static_cast<void>(root_edge);
  TileValues<float>& roughness = tile.channel(Channel::kRoughness);
  std::fill(roughness.values.begin(), roughness.values.end(), 0.5f);
}

}  // namespace globe::planet
