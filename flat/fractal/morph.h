#pragma once

#include <array>

#include "flat/fractal/mesh.h"

namespace globe::flat::fractal {

/// Distances from the viewer between which the vertices that the next coarser level lacks go over to where it
/// has the ground, in sides of a block along the plane: one band for each level but the coarsest.
///
/// Rings change only when blocks are paged, wherever in the box about the middle the viewer then is. Before a
/// block can change, all of it is past its band's end, so that nothing moves at that moment.
struct MorphBands {
  std::array<float, kLevels - 1> begin{};
  std::array<float, kLevels - 1> end{};
};

/// Where rings are too narrow for a level's band, or with `morph` off, that level changes at once: its band
/// lies beyond all distances.
/// @param slack  PagerSettings::slack
MorphBands morph_bands(const Rings& rings, double slack, bool morph);

/// Share of a vertex's way, shaders/flat/fractal_morph.glsl compiled here.
/// @param away  from the viewer along the plane, sides of a block
float morph_share(const MorphBands& bands, int level, float away);

/// The level whose meshes a post is the last to be in: 0 where column or row is odd, 1 where a half of one
/// is, 2 for others, which never move.
int last_level(int column, int row);

/// The two posts that the coarser mesh has the post between, by which it goes; offsets in posts. REQUIRES:
/// last_level(column, row) < kLevels - 1
struct Ends {
  int columns, rows;  ///< to the one; to the other: as far the opposite way
};
Ends ends_of(int column, int row);

}  // namespace globe::flat::fractal
