#include "globe/planet/subdivision.h"

#include <gtest/gtest.h>

#include <map>

namespace globe::planet {
namespace {

Whole<double> whole_at(int level) {
  Whole<double> whole;
  for (int d = 0; d < kDiamonds; ++d)
    whole[static_cast<std::size_t>(d)] = TileValues<double>({d, level, 0, 0});
  return whole;
}

void add_displacement(TileValues<double>& tile) {
  const int n = nodes_per_side(tile.id.level);
  for (int j = tile.id.first_j() - kTileGuard; j <= tile.id.first_j() + tile.id.cells() + kTileGuard; ++j) {
    for (int i = tile.id.first_i() - kTileGuard; i <= tile.id.first_i() + tile.id.cells() + kTileGuard; ++i) {
      if (((i | j) & 1) == 0) continue;
      const bool inside = i >= 0 && j >= 0 && i <= n && j <= n;
      const Node node =
          inside ? Node{tile.id.d, tile.id.level, i, j} : fold({tile.id.d, tile.id.level, i, j});
      tile.at(i, j) += static_cast<double>(vertex_hash(7, octahedral_key(node)) >> 40) / n;
    }
  }
}

/// Fractal values on the whole sphere, every node by its own diamond's stencil and fold: the reference.
Whole<double> reference(int level) {
  Whole<double> whole = whole_at(0);
  for (int d = 0; d < kDiamonds; ++d) {
    for (const ivec2 p : {ivec2{0, 0}, ivec2{1, 0}, ivec2{0, 1}, ivec2{1, 1}}) {
      whole[static_cast<std::size_t>(d)].at(p.x, p.y) =
          static_cast<double>(vertex_hash(7, octahedral_key({d, 0, p.x, p.y})) >> 40);
    }
  }
  for (int l = 1; l <= level; ++l) {
    fill_guard(whole);
    Whole<double> finer = whole_at(l);
    predict(whole, finer);
    for (auto& tile : finer) add_displacement(tile);
    whole = finer;
  }
  fill_guard(whole);
  return whole;
}

TEST(Subdivision, EveryNameOfANodeGetsTheSameValueOnTheWholeSphere) {
  for (int level = 1; level <= 6; ++level) {
    const Whole<double> whole = reference(level);
    const int n = nodes_per_side(level);
    for (int d = 0; d < kDiamonds; ++d) {
      for (int t = 0; t <= n; ++t) {
        for (const ivec2 p : {ivec2{0, t}, ivec2{t, 0}, ivec2{n, t}, ivec2{t, n}}) {
          const Names all = names({d, level, p.x, p.y});
          for (int k = 0; k < all.count; ++k) {
            const Node& name = all.node[static_cast<std::size_t>(k)];
            ASSERT_EQ(whole[static_cast<std::size_t>(d)].at(p.x, p.y),
                      whole[static_cast<std::size_t>(name.d)].at(name.i, name.j));
          }
        }
      }
    }
  }
}

/// Tiles cut from each other must agree, bit for bit, wherever two tiles hold the same vertex: inside, over
/// edges, and around the corners with four triangles. Whoever computes a node, its height is the same.
TEST(Subdivision, TilesAgreeWithEachOtherBitForBitEverywhere) {
  std::map<std::array<int, 4>, TileValues<double>> tiles;
  const Whole<double> whole = reference(6);
  for (int d = 0; d < kDiamonds; ++d) tiles[{d, 6, 0, 0}] = whole[static_cast<std::size_t>(d)];
  std::map<std::array<int, 4>, double> seen;
  for (int level = 7; level <= 9; ++level) {
    const int count = nodes_per_side(level) / kTileCells;
    for (int d = 0; d < kDiamonds; ++d) {
      for (int tj = 0; tj < count; ++tj) {
        for (int ti = 0; ti < count; ++ti) {
          TileValues<double> tile({d, level, ti, tj});
          const TileId up = tile.id.parent();
          predict(tiles.at({up.d, up.level, up.ti, up.tj}), tile);
          add_displacement(tile);
          for (int j = tile.id.first_j(); j <= tile.id.first_j() + kTileCells; ++j) {
            for (int i = tile.id.first_i(); i <= tile.id.first_i() + kTileCells; ++i) {
              const ivec3 key = octahedral_key({d, level, i, j});
              const auto [at, fresh] = seen.try_emplace({level, key.x, key.y, key.z}, tile.at(i, j));
              ASSERT_EQ(at->second, tile.at(i, j))
                  << "diamond " << d << " level " << level << " node " << i << "," << j;
            }
          }
          tiles[{d, level, ti, tj}] = tile;
        }
      }
    }
  }
}

TEST(Subdivision, PredictionReproducesALinearFieldAwayFromCorners) {
  TileValues<double> parent({1, 8, 1, 1});
  for (int j = 60; j <= 132; ++j) {
    for (int i = 60; i <= 132; ++i) parent.at(i, j) = 3.0 * i - 5.0 * j;
  }
  TileValues<double> child({1, 9, 2, 3});
  predict(parent, child);
  for (int j = child.id.first_j() - 4; j <= child.id.first_j() + 68; ++j) {
    for (int i = child.id.first_i() - 4; i <= child.id.first_i() + 68; ++i) {
      ASSERT_NEAR(child.at(i, j), 1.5 * i - 2.5 * j, 1e-9);
    }
  }
}

TEST(Subdivision, ALinearMidpointDoesNotPassForTheButterfly) {
  EXPECT_NE(butterfly_value(1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
            butterfly_value(1.0, 1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0));
}

}  // namespace
}  // namespace globe::planet
