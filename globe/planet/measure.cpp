#include "globe/planet/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "globe/planet/directions.h"
#include "globe/planet/relief.h"

namespace globe::planet {
namespace {

constexpr double kFullRoughness = 0.035;  ///< slope between data nodes where roughness is 1
constexpr double kRoomForRelief = 900.0;  ///< metres above the sea that relief needs to unfold in full

/// To a whole number, for |x| < 2^51: sums of such do not depend on their order.
double whole(double x) {
  constexpr double kNoFraction = 0x1.8p52;
  return (x + kNoFraction) - kNoFraction;
}

/// Square of the slope between two nodes, in whole units of 2^-48.
double squared_rise(double from, double to, double edge_m) {
  const double rise = (to - from) / edge_m;
  return whole(std::min(rise * rise, 4.0) * 0x1p48);
}

/// From the sum of squared_rise over `count` neighbours.
float roughness_from(double sum, double count, double h, bool craters) {
  const double x = std::sqrt(sum * 0x1p-48 / count) / kFullRoughness;
  const double rough = x == 0.0 ? 0.0 : std::min(1.0, 0.012 + std::sqrt(x * std::sqrt(x)));
  // Water does not cut below its base level: coastal lowlands stay low however uneven.
  const double room = h / kRoomForRelief;
  return static_cast<float>(craters ? rough : std::min(rough, 0.004 + room * room));
}

/// What a neighbour adds to the slope at u, in whole units of 2^-40.
dvec3 pull(const dvec3& u, double h, const dvec3& other_u, double other_h, double radius_m) {
  const dvec3 step = other_u - u;
  const dvec3 p = step * ((other_h - h) / (radius_m * glm::dot(step, step)) * 0x1p40);
  return {whole(p.x), whole(p.y), whole(p.z)};
}

vec3 slope_from(const dvec3& sum, double count) { return vec3(sum * (2.0 * 0x1p-40 / count)); }

/// The data around octahedron corners, node by node; heights are asked for once.
class CornerGround {
 public:
  CornerGround(const ReliefScale& scale, const HeightOfNode& height_of)
      : scale_(scale), height_of_(height_of) {}

  float roughness(const Node& node) {
    const double h = height(node);
    double sum = 0.0;
    const Neighbours around = neighbours(node);
    for (std::size_t k = 0; k < around.count; ++k)
      sum += squared_rise(h, height(around.node[k]), scale_.data_edge_m);
    return roughness_from(sum, static_cast<double>(around.count), h, scale_.craters);
  }

  vec3 base_slope(const Node& node) {
    const dvec3 u = node_direction(node);
    const double h = base_height(node);
    dvec3 sum(0.0);
    const Neighbours around = neighbours(node);
    for (std::size_t k = 0; k < around.count; ++k) {
      const Node& other = around.node[k];
      sum += pull(u, h, node_direction(other), base_height(other), scale_.radius_m);
    }
    return slope_from(sum, static_cast<double>(around.count));
  }

 private:
  using Known = std::map<std::array<int, 3>, double>;

  static std::array<int, 3> key_of(const Node& node) {
    const ivec3 key = octahedral_key(node);
    return {key.x, key.y, key.z};
  }

  double height(const Node& node) {
    const auto [at, fresh] = heights_.try_emplace(key_of(node), 0.0);
    if (fresh) at->second = height_of_(node);
    return at->second;
  }

  /// Height without massifs.
  double base_height(const Node& node) {
    const auto [at, fresh] = base_heights_.try_emplace(key_of(node), 0.0);
    if (fresh) {
      const dvec3 u = node_direction(node);
      const float rough = roughness(node);
      ReliefPlaces places;
      for (std::size_t k = 0; k < kLanes; ++k) places.set(k, u, rough, vec3(0.0f));
      at->second = height(node) - static_cast<double>(massif_relief(scale_, places).height_m[0]);
    }
    return at->second;
  }

  struct Neighbours {
    std::array<Node, 6> node;
    std::size_t count = 0;
  };

  /// The six neighbours of a node, four at an octahedron corner.
  static Neighbours neighbours(const Node& node) {
    Neighbours found;
    for (const ivec2 step : kLatticeSteps) {
      const Node other = fold({node.d, node.level, node.i + step.x, node.j + step.y});
      const auto end = found.node.begin() + static_cast<std::ptrdiff_t>(found.count);
      const auto same = [&](const Node& known) { return octahedral_key(known) == octahedral_key(other); };
      if (!is_corner(node) || std::none_of(found.node.begin(), end, same)) found.node[found.count++] = other;
    }
    return found;
  }

  const ReliefScale& scale_;
  const HeightOfNode& height_of_;
  Known heights_, base_heights_;
};

/// True where the six nodes around a plane coordinate may not be the neighbours of the node it means: at
/// octahedron corners, and behind them.
bool near_corner(const TileId& id, int reach, int i, int j) {
  const int n = nodes_per_side(id.level);
  const bool i_edge = i <= 0 || i >= n;
  const bool j_edge = j <= 0 || j >= n;
  const auto near = [&](int x) { return std::min(std::abs(x), std::abs(x - n)) <= reach; };
  if (i > 0 && j > 0 && i < n && j < n) return false;
  if (i >= 0 && j >= 0 && i <= n && j <= n) return i_edge && j_edge;
  return near(i) && near(j);
}

class TileGround {
 public:
  TileGround(const Synthesis& synthesis, const TileValues<double>& height, const HeightOfNode& height_of)
      : scale_(synthesis.relief_scale()),
        height_(height),
        corners_(scale_, height_of),
        directions_(node_directions(height.id, height.guard - 1)),
        roughness_(height.id, 0.0f, height.guard - 1),
        base_height_(height.id, 0.0, height.guard - 1) {
    std::vector<ivec2> nodes;
    for_each_node(height.id, roughness_.guard, [&](int i, int j, const Node& node) {
      roughness_.at(i, j) =
          near_corner(height.id, height.guard, i, j) ? corners_.roughness(node) : roughness(i, j);
      nodes.emplace_back(i, j);
    });
    in_lanes(
        nodes,
        [&](const ivec2& node, std::size_t k, ReliefPlaces& places) {
          const std::size_t at = roughness_.index(node.x, node.y);
          places.set(k, directions_.values[at], roughness_.values[at], vec3(0.0f));
        },
        [&](const ReliefPlaces& places) { return massif_relief(scale_, places); },
        [&](const ivec2& node, std::size_t k, const ReliefLanes& massif) {
          base_height_.at(node.x, node.y) =
              height_.at(node.x, node.y) - static_cast<double>(massif.height_m[k]);
        });
  }

  void write(bool carved, SurfaceTile& tile) {
    std::vector<ivec2> nodes;
    for_each_node(tile.id, height_.guard - kMeasureMargin, [&](int i, int j, const Node& node) {
      tile.channel(Channel::kRoughness).at(i, j) = roughness_.at(i, j);
      if (!carved) return;
      const vec3 slope =
          near_corner(tile.id, height_.guard, i, j) ? corners_.base_slope(node) : base_slope(i, j);
      tile.channel(Channel::kSlopeX).at(i, j) = slope.x;
      tile.channel(Channel::kSlopeY).at(i, j) = slope.y;
      tile.channel(Channel::kSlopeZ).at(i, j) = slope.z;
      nodes.emplace_back(i, j);
    });
    in_lanes(
        nodes,
        [&](const ivec2& node, std::size_t k, ReliefPlaces& places) {
          const auto channel = [&](Channel c) { return tile.channel(c).at(node.x, node.y); };
          places.set(k, directions_.at(node.x, node.y), channel(Channel::kRoughness),
                     {channel(Channel::kSlopeX), channel(Channel::kSlopeY), channel(Channel::kSlopeZ)});
        },
        [&](const ReliefPlaces& places) { return carved_relief(scale_, places); },
        [&](const ivec2& node, std::size_t k, const ReliefLanes& relief) {
          tile.channel(Channel::kCarved).at(node.x, node.y) = relief.height_m[k];
          tile.channel(Channel::kProminence).at(node.x, node.y) = relief.prominence[k];
        });
  }

 private:
  float roughness(int i, int j) const {
    const double h = height_.at(i, j);
    double sum = 0.0;
    for (const ivec2 step : kLatticeSteps)
      sum += squared_rise(h, height_.at(i + step.x, j + step.y), scale_.data_edge_m);
    return roughness_from(sum, 6.0, h, scale_.craters);
  }

  vec3 base_slope(int i, int j) const {
    const dvec3& u = directions_.at(i, j);
    const double h = base_height_.at(i, j);
    dvec3 sum(0.0);
    for (const ivec2 step : kLatticeSteps) {
      sum += pull(u, h, directions_.at(i + step.x, j + step.y), base_height_.at(i + step.x, j + step.y),
                  scale_.radius_m);
    }
    return slope_from(sum, 6.0);
  }

  ReliefScale scale_;
  const TileValues<double>& height_;
  CornerGround corners_;
  TileValues<dvec3> directions_;
  TileValues<float> roughness_;
  TileValues<double> base_height_;  ///< without massifs
};

}  // namespace

void measure_ground(const Synthesis& synthesis, const TileValues<double>& height,
                    const HeightOfNode& height_of, SurfaceTile& tile) {
  TileGround(synthesis, height, height_of).write(synthesis.carved_level() > synthesis.data_level, tile);
}

}  // namespace globe::planet
