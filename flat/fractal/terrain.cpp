#include "flat/fractal/terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace globe::flat::fractal {
namespace {

const TerrainSettings& checked(const TerrainSettings& settings) {
  check(settings.rings);
  return settings;
}

}  // namespace

Terrain::Terrain(const TerrainSettings& settings)
    : settings_(checked(settings)),
      pager_(settings.ground, settings.pager),
      bands_(fractal::morph_bands(settings.rings, settings.pager.slack, settings.morph && settings.lod)),
      tree_(settings.pager.log2_blocks),
      levels_(static_cast<std::size_t>(pager_.blocks()) * static_cast<std::size_t>(pager_.blocks())),
      edges_(levels_.size()) {
  visible_.reserve(levels_.size());
  draws_.reserve(levels_.size());
  // The rings are about the middle of the square, so that levels are the same wherever it goes.
  const int blocks = pager_.blocks();
  for (int row = 0; row < blocks; ++row) {
    for (int column = 0; column < blocks; ++column) {
      levels_[static_cast<std::size_t>(row * blocks + column)] =
          static_cast<std::uint8_t>(settings.lod ? level_of(settings.rings, blocks, column, row) : 0);
    }
  }
  for (int row = 0; row < blocks; ++row) {
    for (int column = 0; column < blocks; ++column) {
      edges_[static_cast<std::size_t>(row * blocks + column)] =
          static_cast<std::uint8_t>(coarser_edges(levels_, blocks, column, row));
    }
  }
}

bool Terrain::move_to(const glm::dvec2& posts) {
  if (!pager_.move_to(posts)) return false;
  const BlockKey first = pager_.first();
  tree_.update([&](int column, int row) {
    const Block& block = pager_.block(pager_.slot({first.x + column, first.y + row}));
    return HeightTree::Range{block.lowest_m, block.highest_m};
  });
  return true;
}

BlockDraw Terrain::block_draw(int column, int row) const {
  const BlockKey first = pager_.first();
  const auto at = static_cast<std::size_t>(row * pager_.blocks() + column);
  return {pager_.slot({first.x + column, first.y + row}), column, row, levels_[at], edges_[at]};
}

const std::vector<BlockDraw>& Terrain::draws(const glm::dmat4& clip_from_relative, const glm::dvec3& eye) {
  const BlockKey first = pager_.first();
  const double spacing = spacing_m();
  const std::array<double, 3> origin{(static_cast<double>(first.x * pager_.cells()) - eye.x) * spacing,
                                     (static_cast<double>(first.y * pager_.cells()) - eye.y) * spacing,
                                     -eye.z};
  if (settings_.culling) {
    culling_counts_ = tree_.visible(view_of(clip_from_relative), origin, pager_.cells() * spacing, visible_);
  } else {
    visible_.resize(levels_.size());
    std::iota(visible_.begin(), visible_.end(), 0);
    culling_counts_ = {};
  }
  draws_.clear();
  for (const int block : visible_)
    draws_.push_back(block_draw(block % pager_.blocks(), block / pager_.blocks()));
  return draws_;
}

float Terrain::drawn_height_m(const BlockDraw& block, int column, int row, const glm::dvec2& eye) const {
  const float* const at =
      pager_.heights(block.slot).data() + (row + 1) * pager_.posts_with_rim() + column + 1;
  const int level = last_level(column, row);
  if (level == kLevels - 1) return *at;
  const BlockKey first = pager_.first();
  const glm::dvec2 post(static_cast<double>((first.x + block.column) * pager_.cells() + column),
                        static_cast<double>((first.y + block.row) * pager_.cells() + row));
  const Ends ends = ends_of(column, row);
  const int other = ends.rows * pager_.posts_with_rim() + ends.columns;
  const float share = morph_share(
      bands_, level, static_cast<float>(glm::distance(post, eye)) / static_cast<float>(pager_.cells()));
  return *at + share * (0.5f * (at[other] + at[-other]) - *at);
}

double Terrain::height_m(const glm::dvec2& posts) const {
  const int cells = pager_.cells();
  const auto i = static_cast<std::int64_t>(std::floor(posts.x));
  const auto j = static_cast<std::int64_t>(std::floor(posts.y));
  const BlockKey key{i >> pager_.pager_settings().log2_cells, j >> pager_.pager_settings().log2_cells};
  const float* at = pager_.heights(pager_.slot(key)).data();
  const int row = pager_.posts_with_rim();
  at += (j - key.y * cells + 1) * row + (i - key.x * cells + 1);
  const double u = posts.x - static_cast<double>(i), v = posts.y - static_cast<double>(j);
  const auto h = [&](int offset) { return static_cast<double>(at[offset]); };
  return std::lerp(std::lerp(h(0), h(1), u), std::lerp(h(row), h(row + 1), u), v);
}

}  // namespace globe::flat::fractal
