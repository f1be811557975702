#include "globe/planet/synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "globe/planet/directions.h"
#include "globe/planet/relief.h"

namespace globe::planet {
namespace {

constexpr double kFinestValley = 75.0;  ///< metres
constexpr double kFinestCrater = 20.0;

constexpr double kFullRoughness = 0.035;  ///< slope between data nodes where roughness is 1
constexpr double kRoomForRelief = 900.0;  ///< metres above the sea that relief needs to unfold in full
constexpr double kNodesPerWave = 3.9;     ///< carving stops where the finest wave has as many

/// Uniform in [-1, 1) from the top bits of a hash.
double signed_unit(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-52 - 1.0; }

constexpr std::uint64_t kSecond = 0x9e3779b97f4a7c15ULL;  ///< a second number from a node's hash
constexpr std::uint64_t kThird = 0xd1342543de82ef95ULL;

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

bool is_new(const Node& node) { return ((node.i | node.j) & 1) != 0 || node.level == 0; }

}  // namespace

double Synthesis::edge_m(int level) const { return std::ldexp(root_edge, -level); }

double Synthesis::finest_wave_m() const { return craters ? kFinestCrater : kFinestValley; }

int Synthesis::carved_level() const {
  int level = data_level;
  while (edge_m(level) * kNodesPerWave > finest_wave_m()) ++level;
  return level;
}

namespace {

ReliefScale relief_scale(const Synthesis& s) {
  return {static_cast<std::uint32_t>(vertex_hash(s.seed, {1, 0, 0}) >> 32), s.root_edge / 1.5707963267948966,
          s.edge_m(s.data_level), s.finest_wave_m(), s.craters};
}

vec3 slope_at(const SurfaceTile& tile, int i, int j) {
  return {tile.channel(Channel::kSlopeX).at(i, j), tile.channel(Channel::kSlopeY).at(i, j),
          tile.channel(Channel::kSlopeZ).at(i, j)};
}

/// New nodes of a level that is still carved.
void carve(const Synthesis& synthesis, bool own_nodes_only, SurfaceTile& tile) {
  const ReliefScale scale = relief_scale(synthesis);
  const TileValues<dvec3> directions = node_directions(tile.id);
  const bool last = tile.id.level == synthesis.carved_level();
  TileValues<float>& carved = tile.channel(Channel::kCarved);
  TileValues<float>& roughness = tile.channel(Channel::kRoughness);
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    const bool fresh = is_new(node);
    if (!fresh && !last) return;
    const ReliefSample r = carved_relief(scale, directions.at(i, j),
                                         std::clamp(roughness.at(i, j), 0.0f, 1.0f), slope_at(tile, i, j));
    if (fresh) {
      tile.height.at(i, j) += static_cast<double>(r.height_m) - static_cast<double>(carved.at(i, j));
      carved.at(i, j) = r.height_m;
      tile.channel(Channel::kProminence).at(i, j) = r.prominence;
    }
    if (last) {
      // From here on roughness is that of the slope the node lies on: flat floors stay smooth.
      const float steep = glm::length(slope_at(tile, i, j) + r.slope);
      roughness.at(i, j) = std::min(1.0f, roughness.at(i, j) * 0.25f + 1.4f * steep);
    }
  });
}

/// New nodes below the last carved level, displaced by their hash: half the slope at every third level below
/// some 50 m, so that ground at eye height undulates gently.
void displace(const Synthesis& synthesis, bool own_nodes_only, SurfaceTile& tile) {
  const double edge = synthesis.edge_m(tile.id.level);
  const double slope = 0.15 * std::sqrt(edge / (edge + 25.0));
  TileValues<float>& roughness = tile.channel(Channel::kRoughness);
  TileValues<float>& prominence = tile.channel(Channel::kProminence);
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
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

/// The data's finest level seen node by node; whatever was worked out once is kept.
class Measurement {
 public:
  Measurement(const Synthesis& synthesis, const HeightOfNode& height_of)
      : scale_(relief_scale(synthesis)), edge_m_(scale_.data_edge_m), height_of_(height_of) {
    known_.reserve(2 * (kTileCells + 16) * (kTileCells + 16));
  }

  float roughness(const Node& node) {
    Known& known = known_[key_of(node)];
    if (known.roughness < 0.0f) {
      const double h = height(node);
      std::int64_t sum = 0;  // in whole units, so that the order of the neighbours does not matter
      const std::vector<Node> around = neighbours(node);
      for (const Node& other : around) {
        const double rise = (height(other) - h) / edge_m_;
        sum += std::llround(std::min(rise * rise, 4.0) * 0x1p48);
      }
      const double rms = std::sqrt(static_cast<double>(sum) * 0x1p-48 / static_cast<double>(around.size()));
      const double x = rms / kFullRoughness;
      const double rough = x == 0.0 ? 0.0 : std::min(1.0, 0.012 + std::sqrt(x * std::sqrt(x)));
      // Water does not cut below its base level: coastal lowlands stay low however uneven.
      const double room = h / kRoomForRelief;
      known_[key_of(node)].roughness =
          static_cast<float>(scale_.craters ? rough : std::min(rough, 0.004 + room * room));
    }
    return known_[key_of(node)].roughness;
  }

  /// Slope of the ground without its massifs.
  vec3 base_slope(const Node& node) {
    const dvec3 u = direction(node);
    const double h = base_height(node);
    glm::i64vec3 sum{0};
    const std::vector<Node> around = neighbours(node);
    for (const Node& other : around) {
      const dvec3 step = direction(other) - u;
      const double distance2 = glm::dot(step, step);
      const dvec3 pull = step * ((base_height(other) - h) / (scale_.radius_m * distance2));
      sum += glm::i64vec3{std::llround(pull.x * 0x1p40), std::llround(pull.y * 0x1p40),
                          std::llround(pull.z * 0x1p40)};
    }
    return vec3(dvec3(sum) * (2.0 * 0x1p-40 / static_cast<double>(around.size())));
  }

  dvec3 direction(const Node& node) {
    Known& known = known_[key_of(node)];
    if (known.direction == dvec3(0.0)) known.direction = node_direction(node);
    return known.direction;
  }

  void know(const Node& node, double h, const dvec3& u) {
    Known& known = known_[key_of(node)];
    known.height = h;
    known.direction = u;
  }

  const ReliefScale& scale() const { return scale_; }

 private:
  struct Known {
    std::optional<double> height;
    float roughness = -1.0f;
    std::optional<double> base_height;
    dvec3 direction{0.0};
  };

  static std::uint64_t key_of(const Node& node) {
    const ivec3 key = octahedral_key(node);
    const auto bits = [](int v) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) & 0x7fffffffu;
    };
    return bits(key.x) << 32 | bits(key.y) << 1 | (key.z < 0 ? 1u : 0u);
  }

  double height(const Node& node) {
    Known& known = known_[key_of(node)];
    if (!known.height) known.height = height_of_(node);
    return *known.height;
  }

  double base_height(const Node& node) {
    const std::uint64_t key = key_of(node);
    if (const auto found = known_.find(key); found != known_.end() && found->second.base_height)
      return *found->second.base_height;
    const double massif =
        static_cast<double>(massif_relief(scale_, direction(node), roughness(node)).height_m);
    const double value = height(node) - massif;
    known_[key].base_height = value;
    return value;
  }

  /// The six neighbours of a node, four at an octahedron corner.
  static std::vector<Node> neighbours(const Node& node) {
    std::vector<Node> found;
    for (const ivec2 step :
         {ivec2{1, 0}, ivec2{0, 1}, ivec2{-1, 1}, ivec2{-1, 0}, ivec2{0, -1}, ivec2{1, -1}}) {
      const Node other = fold({node.d, node.level, node.i + step.x, node.j + step.y});
      const auto same = [&](const Node& known) { return octahedral_key(known) == octahedral_key(other); };
      if (!is_corner(node) || std::none_of(found.begin(), found.end(), same)) found.push_back(other);
    }
    return found;
  }

  ReliefScale scale_;
  double edge_m_;
  const HeightOfNode& height_of_;
  std::unordered_map<std::uint64_t, Known> known_;
};

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
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    if (!is_new(node)) return;
    const BuiltinPlanet::Point point = planet.at(directions.at(i, j));
    tile.height.at(i, j) = point.height_m;
    tile.channel(Channel::kMoisture).at(i, j) = point.moisture;
  });
}

void synthesise_mottle(std::uint64_t seed, bool own_nodes_only, SurfaceTile& tile) {
  TileValues<float>& mottle = tile.channel(Channel::kMottle);
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    if (!is_new(node)) return;
    const std::uint64_t hash = vertex_hash(seed, octahedral_key(node));
    mottle.at(i, j) = 0.88f * mottle.at(i, j) + 0.26f * static_cast<float>(signed_unit(hash * kSecond));
  });
}

void measure_ground(const Synthesis& synthesis, const HeightOfNode& height_of, bool own_nodes_only,
                    SurfaceTile& tile) {
  Measurement measured(synthesis, height_of);
  const TileValues<dvec3> directions = node_directions(tile.id);
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    measured.know(node, tile.height.at(i, j), directions.at(i, j));
  });
  const bool carved = synthesis.carved_level() > synthesis.data_level;
  for_each_node(tile.id, own_nodes_only, [&](int i, int j, const Node& node) {
    const float roughness = measured.roughness(node);
    tile.channel(Channel::kRoughness).at(i, j) = roughness;
    if (!carved) return;
    const vec3 slope = measured.base_slope(node);
    tile.channel(Channel::kSlopeX).at(i, j) = slope.x;
    tile.channel(Channel::kSlopeY).at(i, j) = slope.y;
    tile.channel(Channel::kSlopeZ).at(i, j) = slope.z;
    const ReliefSample r = carved_relief(measured.scale(), directions.at(i, j), roughness, slope);
    tile.channel(Channel::kCarved).at(i, j) = r.height_m;
    tile.channel(Channel::kProminence).at(i, j) = r.prominence;
  });
}

}  // namespace globe::planet
