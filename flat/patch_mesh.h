#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flat/levels.h"
#include "flat/terrain.h"

namespace globe::flat {

/// A vertex of a patch: its post and the nine moves of geomorphing (Wagner), each metres along z, all
/// constant until the patch takes another shape. With f the patch's share, s those of its sides:
///     z + f self + sum over sides (s side + (1 - s) f both)
/// The last serve vertices beside a side whose own moves end on one that moves. (shaders/lib/geomorph.glsl)
struct PatchVertex {
  std::uint8_t column = 0, row = 0;  ///< posts from the patch's south-west corner
  std::uint8_t unused[2]{};
  float z = 0;
  float self = 0;
  std::array<float, kSides> side{};
  std::array<float, kSides> both{};
};

/// The vertices of a patch: all posts of its level, row by row from the south.
std::vector<PatchVertex> patch_vertices(const Terrain& terrain, std::size_t patch, const PatchState& state);

/// z of a vertex: the very code of the vertex shader, compiled here.
float morphed_z(const PatchVertex& vertex, const PatchState& state);

/// Triangles of a shape (PatchState::shape), three indices each, counter-clockwise seen from above. At sides
/// with the posts of level + 1 the others are not used.
std::vector<std::uint16_t> patch_indices(int shape);

}  // namespace globe::flat
