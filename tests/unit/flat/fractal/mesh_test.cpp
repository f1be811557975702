#include "flat/fractal/mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "globe/base/error.h"

namespace globe::flat::fractal {
namespace {

using Post = std::array<int, 2>;
using EdgeCounts = std::map<std::array<Post, 2>, int>;

int twice_area(const Post& a, const Post& b, const Post& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Adds a block's triangles to edges by the posts of the whole square; returns twice the area of the
/// smallest.
int add_block(EdgeCounts& edges, std::set<Post>& posts, int cells, int column, int row, int level,
              unsigned adapted, int& area, int& count) {
  const std::vector<std::uint16_t> triangles = block_triangles(cells, level, adapted);
  int smallest = 1 << 30;
  for (std::size_t k = 0; k < triangles.size(); k += 3) {
    std::array<Post, 3> corner;
    for (std::size_t c = 0; c < 3; ++c) {
      const int post = triangles[k + c];
      corner[c] = {column * cells + post % (cells + 1), row * cells + post / (cells + 1)};
      posts.insert(corner[c]);
    }
    const int twice = twice_area(corner[0], corner[1], corner[2]);
    smallest = std::min(smallest, twice);
    area += twice;
    ++count;
    for (std::size_t c = 0; c < 3; ++c) {
      const Post a = corner[c], b = corner[(c + 1) % 3];
      ++edges[a < b ? std::array<Post, 2>{a, b} : std::array<Post, 2>{b, a}];
    }
  }
  return smallest;
}

TEST(FractalMesh, EveryBlockIsCoveredOnceCounterClockwise) {
  for (const int cells : {4, 8, 16, 32}) {
    for (int level = 0; level < kLevels; ++level) {
      for (unsigned adapted = 0; adapted < (level == kLevels - 1 ? 1u : 16u); ++adapted) {
        EdgeCounts edges;
        std::set<Post> posts;
        int area = 0, count = 0;
        EXPECT_GT(add_block(edges, posts, cells, 0, 0, level, adapted, area, count), 0);
        EXPECT_EQ(area, 2 * cells * cells);
        if (adapted == 0) {
          EXPECT_EQ(count, 2 * (cells >> level) * (cells >> level));
        }
        for (const auto& [edge, uses] : edges) {
          const auto on_border = [&](int axis, int at) {
            return edge[0][static_cast<std::size_t>(axis)] == at &&
                   edge[1][static_cast<std::size_t>(axis)] == at;
          };
          const bool border =
              on_border(0, 0) || on_border(0, cells) || on_border(1, 0) || on_border(1, cells);
          ASSERT_EQ(uses, border ? 1 : 2) << cells << " " << level << " " << adapted;
        }
      }
    }
  }
}

struct Closed {
  int holes = 0;  ///< inner edges that are not used exactly twice
  int euler = 0;
};

Closed close_square(int blocks, int cells, const Rings& rings, bool adapt) {
  std::vector<std::uint8_t> levels;
  for (int k = 0; k < blocks * blocks; ++k)
    levels.push_back(static_cast<std::uint8_t>(level_of(rings, blocks, k % blocks, k / blocks)));
  EdgeCounts edges;
  std::set<Post> posts;
  int area = 0, count = 0;
  for (int k = 0; k < blocks * blocks; ++k) {
    const int column = k % blocks, row = k / blocks;
    add_block(edges, posts, cells, column, row, levels[static_cast<std::size_t>(k)],
              adapt ? coarser_edges(levels, blocks, column, row) : 0u, area, count);
  }
  const int side = blocks * cells;
  Closed result;
  for (const auto& [edge, uses] : edges) {
    bool rim = false;
    for (std::size_t axis = 0; axis < 2; ++axis)
      rim |= edge[0][axis] == edge[1][axis] && (edge[0][axis] == 0 || edge[0][axis] == side);
    result.holes += uses != (rim ? 1 : 2);
  }
  result.euler = static_cast<int>(posts.size()) - static_cast<int>(edges.size()) + count;
  return result;
}

TEST(FractalMesh, BlocksOfAllLevelsCloseWithoutGapOrTVertex) {
  for (const Rings& rings : {Rings{4, 9}, Rings{0, 1.5}, Rings{1, 2.5}, Rings{2.2, 3.7}, Rings{3, 20}}) {
    for (const int cells : {4, 8}) {
      const Closed closed = close_square(16, cells, rings, true);
      EXPECT_EQ(closed.holes, 0) << rings.fine;
      EXPECT_EQ(closed.euler, 1) << rings.fine;
    }
  }
  EXPECT_GT(close_square(16, 8, {4, 9}, false).holes, 0);  // that T-vertices would be found
}

TEST(FractalMesh, NeighboursAreWithinOneLevelEvenAcrossCorners) {
  constexpr int kBlocks = 64;
  for (double fine = 0; fine < 20; fine += 0.7) {
    const Rings rings{fine, fine + 1.4143};
    check(rings);
    for (int row = 1; row < kBlocks; ++row) {
      for (int column = 1; column < kBlocks; ++column) {
        const int own = level_of(rings, kBlocks, column, row);
        for (const auto& [x, y] : {Post{1, 0}, Post{0, 1}, Post{1, 1}})
          ASSERT_LE(std::abs(level_of(rings, kBlocks, column - x, row - y) - own), 1);
      }
    }
  }
}

TEST(FractalMesh, RingsNarrowerThanABlockAreRefused) {
  EXPECT_THROW(check(Rings{4, 5.4}), UsageError);
  EXPECT_THROW(check(Rings{-1, 5}), UsageError);
  EXPECT_THROW(check(Rings{4, std::numeric_limits<double>::quiet_NaN()}), UsageError);
  EXPECT_NO_THROW(check(Rings{}));
}

}  // namespace
}  // namespace globe::flat::fractal
