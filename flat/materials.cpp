#include "flat/materials.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "flat/lightmap.h"

namespace globe::flat {
namespace {

std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// [0, 1) at the corners of a lattice that repeats after `cells`, smooth between.
double periodic_noise(double x, double y, int cells, std::uint32_t seed) {
  const double i = std::floor(x), j = std::floor(y);
  const auto corner = [&](int di, int dj) {
    const auto a = static_cast<std::uint32_t>((static_cast<int>(i) + di) % cells);
    const auto b = static_cast<std::uint32_t>((static_cast<int>(j) + dj) % cells);
    return mixed(seed ^ mixed(a ^ mixed(b + 0x9e3779b9u))) / 4294967296.0;
  };
  const double u = glm::smoothstep(0.0, 1.0, x - i), v = glm::smoothstep(0.0, 1.0, y - j);
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), u), glm::mix(corner(0, 1), corner(1, 1), u), v);
}

/// Octaves of it from 0 to 1 over a tile, values by texel.
std::vector<double> octaves(int side, int cells, double roughness, std::uint32_t seed) {
  std::vector<double> values(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  double whole = 0.0, share = 1.0;
  for (int n = cells; n <= side / 2; n *= 2, share *= roughness) whole += share;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      double sum = 0.0;
      share = 1.0;
      for (int n = cells; n <= side / 2; n *= 2, share *= roughness)
        sum += share * periodic_noise(static_cast<double>(x) * n / side, static_cast<double>(y) * n / side, n,
                                      seed + static_cast<std::uint32_t>(n));
      values[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)] =
          sum / whole;
    }
  }
  return values;
}

std::uint8_t code(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0) + 0.5); }

}  // namespace

Tile noise_tile(int side, int cells, double roughness, std::uint32_t seed) {
  Tile tile{side, {}};
  for (const double value : octaves(side, cells, roughness, seed))
    tile.texels.push_back(code(128.0 * (0.45 + 1.1 * value)));
  return tile;
}

Tile cloud_tile(int side, double cover, std::uint32_t seed) {
  std::vector<double> values = octaves(side, 4, 0.55, seed);
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto rank =
      static_cast<std::size_t>((1.0 - std::clamp(cover, 0.0, 1.0)) * static_cast<double>(sorted.size() - 1));
  Tile tile{side, {}};
  for (const double value : values)
    tile.texels.push_back(code(255.0 * glm::smoothstep(-0.04, 0.04, value - sorted[rank])));
  return tile;
}

Material make_material(const Terrain& terrain, std::string name, Tile tile, double tile_m, double turn_deg,
                       std::vector<std::uint8_t> mask) {
  const double turn = turn_deg * std::numbers::pi / 180.0;
  Material material{std::move(name), std::move(tile), {}, {}, std::move(mask), {}};
  material.u_row = glm::vec4(glm::dvec4(std::cos(turn) / tile_m, std::sin(turn) / tile_m, 0.0, 0.0));
  material.v_row = glm::vec4(glm::dvec4(-std::sin(turn) / tile_m, std::cos(turn) / tile_m, 0.0, 0.0));
  material.in_patch.assign(terrain.patch_count(), material.mask.empty());
  const auto columns = static_cast<std::size_t>(terrain.posts().columns);
  for (std::size_t k = 0; k < material.mask.size(); ++k) {
    if (material.mask[k] == 0) continue;
    // A post on a border is in both patches.
    const int column = static_cast<int>(k % columns), row = static_cast<int>(k / columns);
    for (const int j : {(row - 1) / kPatchCells, row / kPatchCells}) {
      for (const int i : {(column - 1) / kPatchCells, column / kPatchCells}) {
        if (i < 0 || j < 0 || i >= terrain.patches_east() || j >= terrain.patches_north()) continue;
        material.in_patch[static_cast<std::size_t>(j * terrain.patches_east() + i)] = true;
      }
    }
  }
  return material;
}

std::vector<Material> grass_stone_and_mud(const Terrain& terrain) {
  constexpr int kSide = 256;
  double low = 1e30, high = -1e30;
  for (std::size_t k = 0; k < terrain.patch_count(); ++k) {
    low = std::min(low, static_cast<double>(terrain.patch(k).lowest_m));
    high = std::max(high, static_cast<double>(terrain.patch(k).highest_m));
  }
  std::vector<std::uint8_t> stone, mud;
  for (int row = 0; row < terrain.posts().rows; ++row) {
    for (int column = 0; column < terrain.posts().columns; ++column) {
      const glm::vec3 n = post_normal(terrain, column, row);
      const double slope = std::hypot(n.x, n.y) / n.z;
      const double share = (static_cast<double>(terrain.z(column, row)) - low) / std::max(high - low, 1.0);
      stone.push_back(code(255.0 * glm::smoothstep(0.45, 0.8, slope)));
      mud.push_back(code(255.0 * (1.0 - glm::smoothstep(0.12, 0.3, share)) *
                         (1.0 - glm::smoothstep(0.1, 0.25, slope))));
    }
  }
  std::vector<Material> materials;
  materials.push_back(make_material(terrain, "grass", noise_tile(kSide, 16, 0.9, 1), 12.0, 0.0));
  materials.push_back(
      make_material(terrain, "stone", noise_tile(kSide, 4, 0.65, 2), 30.0, 27.0, std::move(stone)));
  materials.push_back(
      make_material(terrain, "mud", noise_tile(kSide, 8, 0.45, 3), 20.0, 61.0, std::move(mud)));
  return materials;
}

}  // namespace globe::flat
