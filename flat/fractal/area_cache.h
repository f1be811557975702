#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flat/fractal/ground.h"

namespace globe::flat::fractal {

/// A block of ground, 2^log2_cells cells a side, by its number eastward and northward: posts
/// x * 2^log2_cells to (x + 1) * 2^log2_cells, both included, so that neighbours share a border.
struct BlockKey {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend bool operator==(const BlockKey&, const BlockKey&) = default;
};

/// Makes blocks, each with one post of its neighbours around it for slopes.
///
/// What blocks have in common is kept: the posts of whole areas at the blocks' corners (and one beyond), the
/// least recently used area going first. A block is then log2_cells iterations away, and comes out the same
/// to the last bit whatever is kept; the cache is only speed.
class BlockMaker {
 public:
  /// @param log2_cells    2 to 6 and at most the iterations of the ground
  /// @param cached_areas  0: none are kept; Christopoulos has 8. Throws UsageError beyond 0 to 4096.
  BlockMaker(const Settings& settings, int log2_cells, int cached_areas);

  const Ground& ground() const { return ground_; }
  int cells() const { return 1 << log2_cells_; }
  /// Posts a side that make() writes: the block's own and one beyond on either side.
  int posts_with_rim() const { return cells() + 3; }
  /// Blocks along the side of what the cache keeps as one: the area, or a part of it of 128 blocks a side.
  std::int64_t blocks_per_area() const { return std::int64_t{1} << log2_blocks_; }

  /// Row by row from the south-west, the rim included. REQUIRES: out.size() == posts_with_rim() squared
  void make(const BlockKey& key, std::span<float> out);

  struct Counts {
    std::uint64_t blocks = 0, hits = 0, misses = 0;
  };
  const Counts& counts() const { return counts_; }

 private:
  struct Area {
    BlockKey key;
    std::uint64_t last_used = 0;  ///< 0: never
    std::vector<float> heights;
  };

  PostRect area_rect(const BlockKey& area) const;
  const Area& area(const BlockKey& key);

  Ground ground_;
  int log2_cells_;
  int log2_blocks_;
  std::vector<Area> areas_;
  std::uint64_t now_ = 0;
  Counts counts_;
  Ground::Workspace workspace_;
};

}  // namespace globe::flat::fractal
