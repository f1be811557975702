#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "flat/terrain.h"

namespace globe::flat {

/// A square grey texture that repeats without a seam; 128 is brightness 1.
struct Tile {
  int side = 0;  ///< texels, a power of two
  std::vector<std::uint8_t> texels;
};

/// What a part of the ground is made of: a tile that its brightness is multiplied by, and where it is.
struct Material {
  std::string name;
  Tile tile;
  /// Texture coordinates are dot((x, y, 0, 1), row) of a place of the plane in metres, one row for each: any
  /// turn, scale and shift.
  glm::vec4 u_row{0.0f}, v_row{0.0f};
  /// A byte a post, 255 where there is nothing else; empty: everywhere, for the first one.
  std::vector<std::uint8_t> mask;
  std::vector<bool> in_patch;  ///< false where the mask is 0 all over the patch: its pass is skipped there
};

/// The material over the whole region that the others lie on, or one with a mask of a byte a post.
Material make_material(const Terrain& terrain, std::string name, Tile tile, double tile_m, double turn_deg,
                       std::vector<std::uint8_t> mask = {});

/// Grass everywhere, stone where it is steep, mud on the low flats: Wagner's three.
std::vector<Material> grass_stone_and_mud(const Terrain& terrain);

/// Noise of octaves, each of half the size and `roughness` of the height of the one before; the first has
/// `cells` a side. Deterministic.
Tile noise_tile(int side, int cells, double roughness, std::uint32_t seed);
/// Shadows of clouds over `cover` of the sky: 0 in the sun, 255 under a cloud.
Tile cloud_tile(int side, double cover, std::uint32_t seed);

}  // namespace globe::flat
