#pragma once

#include <optional>
#include <string_view>

namespace globe::clipmap {

/// How the places of vertices are had: what accuracy costs (tests/bench/results/positions-*.md).
enum class Positions {
  kExact,      ///< offsets from the level's anchor, in double for every vertex, rounded once
  kQuadratic,  ///< in fp32 from a second-order patch through the corners and edge middles of each patch
  kChord,    ///< in fp32 from the flat triangle between each patch's corners: the thesis' interpolated block
  kFloat32,  ///< coordinates from the planet's centre, computed and moved to the camera in fp32
};

/// The words of --positions: exact, quadratic, chord, float32; nothing for another.
std::optional<Positions> positions_by_name(std::string_view name);

std::string_view name_of(Positions positions);

/// Whether a vertex is its height over a surface between knots (globe/clipmap/patch_surface.h), so that the
/// windows hold heights and knots in place of positions.
inline bool is_interpolated(Positions positions) {
  return positions == Positions::kQuadratic || positions == Positions::kChord;
}

}  // namespace globe::clipmap
