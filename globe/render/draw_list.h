#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "globe/clipmap/culling.h"
#include "globe/clipmap/morph.h"
#include "globe/clipmap/stream.h"
#include "globe/render/camera.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/room.h"

namespace globe::render {

/// Mirrors `Slot` in shaders/clipmap.vert (std140).
struct SlotBlock {
  glm::vec4 offset{0.0f};
  glm::ivec4 torus{0};
  glm::ivec4 images_a{0};
  glm::ivec4 images_b{0};
  glm::ivec4 coarse{0};
  glm::vec4 shading{0.0f};
};
inline constexpr int kMaxSlots = 128;

/// How a patch is drawn: without morphing, with it, or at a rim beside the coarser level.
enum class Kind { kPlain, kMorphing, kRim };

/// Whose shading the pixels of a patch show.
enum class Shading {
  kFine,    ///< the level's own
  kCoarse,  ///< the coarser level's
  kBoth,    ///< a share of each
  kGlint,   ///< a share of each (at the base level its own), and the sun on water
};

/// How a patch is drawn, whatever its rim: what a program is made for.
struct Look {
  Kind kind = Kind::kPlain;
  Shading shading = Shading::kFine;

  friend auto operator<=>(const Look&, const Look&) = default;
};

/// Every look that a patch can have.
inline constexpr std::array kLooks{
    Look{Kind::kPlain, Shading::kFine},    Look{Kind::kMorphing, Shading::kFine},
    Look{Kind::kMorphing, Shading::kBoth}, Look{Kind::kMorphing, Shading::kCoarse},
    Look{Kind::kRim, Shading::kBoth},      Look{Kind::kRim, Shading::kCoarse},
    Look{Kind::kRim, Shading::kGlint},     Look{Kind::kPlain, Shading::kGlint}};

/// Patches of one look and rim variant: one instanced draw.
struct Batch {
  Look look;
  int rim = 0;                         ///< edges on the rim: which index list
  int rim_corners = 0;                 ///< corners that touch it
  bool water = false;                  ///< a sea is to be drawn over some of each
  RoomSide room = RoomSide::kOutside;  ///< where a region is drawn in their place
  std::vector<glm::ivec4> instances;  ///< corner 0 from the window's first node (i, j), ±1 for the half, slot
};

/// Everything to draw of the ground this frame.
struct DrawList {
  std::vector<SlotBlock> slots;
  std::vector<Batch> batches;
  std::size_t patches = 0;

  /// A sea is to be drawn over any of them.
  bool has_water() const {
    return std::any_of(batches.begin(), batches.end(), [](const Batch& batch) { return batch.water; });
  }
};

/// Chooses the patches in view, finest level first.
///
/// @param shown   levels of the state above it are left out
/// @param cull    false: every patch of the mesh, for tests
/// @param room    where something else draws the ground; null: nowhere
DrawList make_draw_list(const clipmap::Settings& settings, const clipmap::ClipmapState& state,
                        const ClipmapTextures& textures, const geo::Ellipsoid& ellipsoid,
                        const Camera& camera, clipmap::FinestLevel shown, bool cull,
                        const Room* room = nullptr);

}  // namespace globe::render
