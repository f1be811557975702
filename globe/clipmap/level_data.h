#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "globe/clipmap/lighting.h"
#include "globe/clipmap/region.h"
#include "globe/clipmap/vertex_block.h"
#include "globe/planet/surface.h"

namespace globe::clipmap {

/// A rectangle of one layer's shading to upload, at the level's shading level.
struct ShadingBlock {
  int d = 0;
  NodeRect nodes;                   ///< nodes of the shading level
  std::vector<glm::u8vec4> lit;     ///< shaders/lib/lit_ground.glsl
  std::vector<std::uint8_t> water;  ///< 255 where there is open water
};

/// Sphere around everything a patch can be drawn as, metres from the level's anchor, and how high above the
/// ellipsoid that reaches; with the sea over it where its floor is bare.
struct PatchBounds {
  glm::vec3 centre{0.0f};
  float radius = 0;
  float highest = 0;
  float lowest = 0;    ///< height of its lowest vertex
  bool water = false;  ///< a sea is to be drawn over some of it
};

/// Shading nodes that were made together. What stays of them from state to state is shared, not copied.
struct GroundPart {
  NodeRect made;   ///< that `nodes` holds
  NodeRect valid;  ///< that is still resident; those of a level's parts cover its window without overlap
  std::shared_ptr<const ShadingNodes> nodes;
};

/// What is resident of one level: CPU side of its windows. Immutable once made; the next one is made from it.
struct LevelData {
  Region region;
  dvec3 anchor{0.0};                                 ///< ECEF metres, a pure function of the region's centre
  std::array<NodeRect, planet::kDiamonds> vertices;  ///< resident nodes of each diamond
  std::array<NodeRect, planet::kDiamonds> shading;   ///< resident nodes of each diamond at the shading level
  std::array<std::vector<glm::vec4>, planet::kDiamonds> positions;  ///< of `vertices`, as drawn
  std::array<std::vector<glm::vec4>, planet::kDiamonds>
      coarse;  ///< of `vertices`: where they go at α = 1; only with hexagons, which upload them piece by
               ///< piece
  std::array<std::vector<NodeRect>, planet::kDiamonds> footprint;  ///< of `vertices`, what textures hold
  std::array<std::vector<GroundPart>, planet::kDiamonds>
      ground;                       ///< of `shading`, to be lit when the sun moves
  Lighting lighting;                ///< that the uploaded shading was lit with
  std::vector<Patch> patches;       ///< every patch of the region, sorted by trixel, rim marked
  std::vector<PatchBounds> bounds;  ///< of `patches`
  double lowest_m = 0;              ///< height that no triangle between `positions` lies below
};

/// A new state of a level and what has to be uploaded to get there from the one before.
struct LevelUpdate {
  std::shared_ptr<const LevelData> data;
  std::vector<VertexBlock> vertex_blocks;
  std::vector<ShadingBlock> shading_blocks;

  std::size_t upload_bytes() const;
};

/// Shared origin of a level's offsets: the drawn ground at the node nearest to the region's centre on the
/// lattice of the largest power of two up to 2s cells. The planet's centre at the base level, and with
/// Positions::kFloat32.
dvec3 level_anchor(const Settings& settings, const planet::Surface& surface, const Region& region);

/// Computes what a level needs for `region`: only nodes that `before` (null: nothing) does not hold, unless
/// the anchor or the light changed. Safe to call from any thread.
LevelUpdate update_level(const Settings& settings, const planet::Surface& surface, Region region,
                         const Lighting& lighting, const LevelData* before);

}  // namespace globe::clipmap
