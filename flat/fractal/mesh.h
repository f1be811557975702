#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flat/fractal/area_cache.h"

namespace globe::flat::fractal {

inline constexpr int kLevels = 3;  ///< 0: every post of a block; 1: every second; 2: every fourth

/// Sides of a block beyond which its neighbour is coarser: a sum of these.
enum Edge : unsigned { kWest = 1, kEast = 2, kSouth = 4, kNorth = 8 };

/// Triangles of a block, as post numbers row * (cells + 1) + column, counter-clockwise seen from above.
///
/// Along an edge with a coarser neighbour the finer block leaves out every second of its posts: each is drawn
/// together with the post before it, and triangles that vanish so are left out. Both sides of the edge then
/// have the same posts: no gap and no T-vertex. (Christopoulos hides gaps with upright triangles.)
/// REQUIRES: cells a power of two, at least 4; level < kLevels; no edges at the coarsest level
std::vector<std::uint16_t> block_triangles(int cells, int level, unsigned edges);

/// Radii of the rings of levels, about the middle of the square, in sides of a block: blocks whose middle is
/// nearer than the first have level 0, nearer than the second level 1, others 2.
struct Rings {
  double fine = 4.0;
  double medium = 9.0;
};

/// Throws UsageError unless 0 <= fine and the second ring is as wide as a block's diagonal, which keeps
/// neighbours within one level of each other.
void check(const Rings& rings);

/// Level of a block by its place in the square of 2^n blocks a side.
int level_of(const Rings& rings, int blocks, int column, int row);

/// The edges of a block beyond which blocks of the same square are one level coarser.
unsigned coarser_edges(std::span<const std::uint8_t> levels, int blocks, int column, int row);

}  // namespace globe::flat::fractal
