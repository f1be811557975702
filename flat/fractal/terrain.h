#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "flat/fractal/culling.h"
#include "flat/fractal/mesh.h"
#include "flat/fractal/morph.h"
#include "flat/fractal/pager.h"

namespace globe::flat::fractal {

struct TerrainSettings {
  Settings ground;
  PagerSettings pager;
  Rings rings;
  bool lod = true;      ///< off: every block at level 0
  bool morph = true;    ///< off: levels change at once
  bool culling = true;  ///< off: every block is drawn
};

/// A block to draw.
struct BlockDraw {
  int slot = 0;             ///< of the pager
  int column = 0, row = 0;  ///< in the pager's square
  int level = 0;
  unsigned edges = 0;  ///< block_triangles
};

/// Endless ground around a viewer: what to draw of it, without graphics. After Christopoulos 1999, chapter 4:
/// paging, three levels by rings, which change only when blocks are paged and are morphed into each other
/// until then, and the quad tree of boxes.
///
/// The ground lies flat: x east, y north, z up.
class Terrain {
 public:
  /// Throws UsageError for settings out of range.
  explicit Terrain(const TerrainSettings& settings);

  const TerrainSettings& settings() const { return settings_; }
  const Pager& pager() const { return pager_; }
  double spacing_m() const { return settings_.ground.spacing_m(); }

  /// Pages for a viewer at a place, in posts. True when blocks changed.
  bool move_to(const glm::dvec2& posts);

  /// Where levels go over into each other.
  const MorphBands& morph_bands() const { return bands_; }
  /// Height at which a post of a block is drawn, metres.
  /// @param column, row  of the block, 0 to cells()
  /// @param eye          posts east and north
  float drawn_height_m(const BlockDraw& block, int column, int row, const glm::dvec2& eye) const;

  /// Level of a block of the square.
  int level(int column, int row) const {
    return levels_[static_cast<std::size_t>(row * pager_.blocks() + column)];
  }
  BlockDraw block_draw(int column, int row) const;

  /// What to draw for a view, nearest first where it is culled.
  /// @param clip_from_relative  of metres from the eye
  /// @param eye  posts east and north, metres up
  const std::vector<BlockDraw>& draws(const glm::dmat4& clip_from_relative, const glm::dvec3& eye);

  /// Of the last draws().
  const HeightTree::Counts& culling_counts() const { return culling_counts_; }

  /// Height of the ground under a place, posts, by the bilinear of its four posts at level 0.
  /// REQUIRES: the place lies in the square
  double height_m(const glm::dvec2& posts) const;

 private:
  TerrainSettings settings_;
  Pager pager_;
  MorphBands bands_;
  HeightTree tree_;
  std::vector<std::uint8_t> levels_;
  std::vector<std::uint8_t> edges_;
  std::vector<int> visible_;
  std::vector<BlockDraw> draws_;
  HeightTree::Counts culling_counts_;
};

}  // namespace globe::flat::fractal
