#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "flat/fractal/area_cache.h"

namespace globe::flat::fractal {

struct PagerSettings {
  int log2_cells = 3;    ///< cells along a block's side, 2 to 6
  int log2_blocks = 5;   ///< blocks along the side of what is there, 2 to 8; with log2_cells at most 12
  double slack = 0.25;   ///< how much wider than a block the box is that one stays in, blocks, 0 to 1
  int cached_areas = 8;  ///< see BlockMaker
};

/// What is kept of a block.
struct Block {
  BlockKey key;
  float lowest_m = 0, highest_m = 0;  ///< over its posts, borders included
};

/// The square of blocks around a viewer, which goes where the viewer goes, without end.
///
/// The viewer sits in a box about the middle of the square, `1 + slack` blocks wide. Past a side of it, rows
/// of blocks go on the far side and are made ahead, until the box holds the viewer again; the way back to the
/// other side is then `slack`, so that no wandering about a border pages again and again. Blocks lie at their
/// numbers modulo the square's side: what stays is neither moved nor made again, and nothing is allocated.
class Pager {
 public:
  /// Throws UsageError for settings out of range.
  Pager(const Settings& settings, const PagerSettings& pager);

  const PagerSettings& pager_settings() const { return pager_; }
  const Ground& ground() const { return maker_.ground(); }
  int blocks() const { return 1 << pager_.log2_blocks; }  ///< along a side
  int cells() const { return maker_.cells(); }            ///< along a block's side
  int posts_with_rim() const { return maker_.posts_with_rim(); }

  /// The lattice corner between blocks that the square is centred on.
  BlockKey middle() const { return middle_; }
  /// The south-western block.
  BlockKey first() const { return {middle_.x - blocks() / 2, middle_.y - blocks() / 2}; }

  /// Goes to a place, in posts of the finest depth; true when blocks changed. The same double holds 1e7
  /// blocks and a hundred-millionth of a post. REQUIRES: coordinates within 2^52
  bool move_to(const glm::dvec2& posts);

  /// Where a block lies, 0 to blocks() squared - 1. REQUIRES: the block is in the square
  int slot(const BlockKey& key) const;
  const Block& block(int slot) const { return blocks_[static_cast<std::size_t>(slot)]; }
  /// Its posts with the rim (BlockMaker::make).
  std::span<const float> heights(int slot) const;

  struct Counts {
    std::uint64_t moves = 0;             ///< that paged
    std::uint64_t blocks = 0;            ///< made
    std::uint64_t hits = 0, misses = 0;  ///< of the area cache
  };
  Counts counts() const;

 private:
  void fill();

  PagerSettings pager_;
  BlockMaker maker_;
  BlockKey middle_;
  bool empty_ = true;
  std::uint64_t moves_ = 0;
  std::vector<Block> blocks_;
  std::vector<float> heights_;
};

/// How far a box must go, whole steps, to hold `place`: 0 while it lies within half a step and half the slack
/// of the middle.
std::int64_t steps_to_hold(double place, double middle, double slack);

}  // namespace globe::flat::fractal
