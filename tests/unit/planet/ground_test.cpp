#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "globe/planet/appearance.h"
#include "globe/planet/directions.h"
#include "globe/planet/scenic.h"
#include "globe/planet/synthesis.h"

namespace globe::planet {
namespace {

constexpr double kHighest = 9000.0;

/// A node of level 20 in each kind of place the grid has.
struct NamedNode {
  const char* name;
  Node node;
};
const std::array<NamedNode, 6> kNamedNodes{{
    {"inside a face", {1, 20, 300000, 200000}},
    {"the equator's edge between two trixels of one diamond", {2, 20, 400000, 648576}},
    {"an edge between two diamonds", {0, 20, 0, 700001}},
    {"the north pole", {3, 20, 0, 0}},
    {"the south pole", {2, 20, 1 << 20, 1 << 20}},
    {"an equatorial corner", {1, 20, 1 << 20, 0}},
}};

Node at_level(const Node& node, int level) {
  return {node.d, level, node.i >> (node.level - level), node.j >> (node.level - level)};
}

/// The tiles around a node, by every diamond that sees it.
std::vector<TileId> tiles_around(const Node& node) {
  std::vector<TileId> tiles;
  const Names all = names(node);
  for (int k = 0; k < all.count; ++k) {
    for (int dj = -kTileCells; dj <= kTileCells; dj += kTileCells / 2) {
      for (int di = -kTileCells; di <= kTileCells; di += kTileCells / 2) {
        const Node& name = all.node[static_cast<std::size_t>(k)];
        const TileId id = tile_of(fold({name.d, name.level, name.i + di, name.j + dj}));
        if (std::find(tiles.begin(), tiles.end(), id) == tiles.end()) tiles.push_back(id);
      }
    }
  }
  return tiles;
}

TEST(Ground, TilesAgreeBitForBitWhereverTheyHoldTheSameVertex) {
  const auto surface = Surface::builtin(1);
  for (const NamedNode& spot : kNamedNodes) {
    for (const int level : {7, 8, 9, 10, 11, 12, 14, 19, 20}) {
      std::map<std::array<int, 3>, std::array<float, kChannels + 2>> seen;
      int shared = 0;
      for (const TileId& id : tiles_around(at_level(spot.node, level))) {
        const auto tile = surface->tile(id);
        const int n = nodes_per_side(level);
        for (int j = id.first_j() - kTileGuard; j <= id.first_j() + id.cells() + kTileGuard; ++j) {
          for (int i = id.first_i() - kTileGuard; i <= id.first_i() + id.cells() + kTileGuard; ++i) {
            const bool inside = i >= 0 && j >= 0 && i <= n && j <= n;
            const ivec3 key = octahedral_key(inside ? Node{id.d, level, i, j} : fold({id.d, level, i, j}));
            std::array<float, kChannels + 2> values{};
            const double height = tile->height.at(i, j);
            values[0] = static_cast<float>(height);
            values[1] = static_cast<float>(height - static_cast<double>(values[0]));
            for (std::size_t c = 0; c < kChannels; ++c)
              values[c + 2] = tile->value(static_cast<Channel>(c), i, j);
            const auto [at, fresh] = seen.try_emplace({key.x, key.y, key.z}, values);
            shared += fresh ? 0 : 1;
            ASSERT_EQ(at->second, values) << spot.name << ", level " << level << ", tile of diamond " << id.d
                                          << ", node " << i << "," << j;
          }
        }
      }
      EXPECT_GT(shared, 100) << spot.name;
    }
  }
}

TEST(Ground, ATileHoldsNoMoreThanItsLevelNeeds) {
  const auto surface = Surface::builtin(1);
  const auto channels_at = [&](int level) {
    int count = 0;
    for (const TileValues<float>& channel : surface->tile(tile_of({0, level, 5, 5}))->channels)
      count += channel.values.empty() ? 0 : 1;
    return count;
  };
  EXPECT_EQ(channels_at(8), 2) << "moisture and mottle";
  EXPECT_EQ(channels_at(9), 8) << "and roughness, prominence, what is carved and its base slope";
  EXPECT_EQ(channels_at(19), 8);
  EXPECT_EQ(channels_at(22), 4);
}

TEST(Ground, HeightsDoNotDependOnTheOrderTilesAreVisitedIn) {
  const auto once = Surface::builtin(3);
  const auto again = Surface::builtin(3, 0);  // keeps as few tiles as it can
  std::vector<Node> nodes;
  std::mt19937 random(5);
  for (int k = 0; k < 12; ++k) {
    const int level = std::uniform_int_distribution<int>(8, 22)(random);
    std::uniform_int_distribution<int> at(0, nodes_per_side(level));
    nodes.push_back({static_cast<int>(random() % 4), level, at(random), at(random)});
  }
  std::vector<double> forward;
  for (const Node& node : nodes) forward.push_back(once->height(node));
  for (std::size_t k = nodes.size(); k-- > 0;) ASSERT_EQ(again->height(nodes[k]), forward[k]);
}

TEST(Ground, ACoarseNodeKeepsItsHeightAtEveryFinerLevel) {
  const auto surface = Surface::builtin(1);
  for (const NamedNode& spot : kNamedNodes) {
    const Node coarse = at_level(spot.node, 6);
    const double height = surface->height(coarse);
    for (int level = 7; level <= 24; ++level) {
      const int shift = level - coarse.level;
      ASSERT_EQ(surface->height(Node{coarse.d, level, coarse.i << shift, coarse.j << shift}), height)
          << spot.name;
    }
  }
}

TEST(Ground, TheBuiltInPlanetIsItsOwnFunctionDownToItsDataLevel) {
  const auto surface = Surface::builtin(1);
  const BuiltinPlanet planet(1);
  std::mt19937 random(1);
  for (int k = 0; k < 60; ++k) {
    std::uniform_int_distribution<int> at(0, nodes_per_side(kBuiltinLevel));
    const Node node{static_cast<int>(random() % 4), kBuiltinLevel, at(random), at(random)};
    ASSERT_EQ(surface->height(node), planet.at(node_direction(node)).height_m);
  }
}

TEST(Ground, NodeDirectionsOfATileAreTheNodesOwnBitForBit) {
  for (const NamedNode& spot : kNamedNodes) {
    for (const int level : {3, 9, 20}) {
      const TileId id = tile_of(at_level(spot.node, level));
      const TileValues<dvec3> directions = node_directions(id);
      for (int j = id.first_j(); j <= id.first_j() + id.cells(); ++j) {
        for (int i = id.first_i() - kTileGuard; i <= id.first_i() + id.cells() + kTileGuard; i += 3)
          ASSERT_EQ(directions.at(i, j), node_direction(fold({id.d, level, i, j}))) << spot.name;
      }
    }
  }
}

/// Where relief is strongest: the tile of the given level that holds the highest node of level 8.
TileId highest_tile(const Surface& surface, int level) {
  constexpr int kLevel = 8;
  Node best{0, kLevel, 1, 1};
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j = 0; j < nodes_per_side(kLevel); ++j)
      for (int i = 0; i < nodes_per_side(kLevel); ++i)
        if (surface.height(Node{d, kLevel, i, j}) > surface.height(best)) best = {d, kLevel, i, j};
  }
  return tile_of({best.d, level, best.i << (level - kLevel), best.j << (level - kLevel)});
}

TEST(Ground, TheBuiltInPlanetStaysWithin9000Metres) {
  double highest = 0.0;
  double lowest = 0.0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto surface = Surface::builtin(seed);
    for (int level = 9; level <= 14; ++level) {
      const auto tile = surface->tile(highest_tile(*surface, level));
      const auto [low, high] = std::minmax_element(tile->height.values.begin(), tile->height.values.end());
      highest = std::max(highest, *high);
      lowest = std::min(lowest, *low);
    }
    for (int d = 0; d < kDiamonds; ++d) {
      for (int t = 0; t < 64; t += 8) {
        const auto tile = surface->tile({d, 12, t, (t * 29 + d) % 64});
        const auto [low, high] = std::minmax_element(tile->height.values.begin(), tile->height.values.end());
        highest = std::max(highest, *high);
        lowest = std::min(lowest, *low);
      }
    }
  }
  EXPECT_LT(highest, kHighest);
  EXPECT_GT(lowest, -kHighest);
  EXPECT_GT(highest, 4500.0);  // and has mountains worth the name
}

/// Mean curvature of the ground across data-cell edges, over that elsewhere. Linear midpoints give about 10.
double crease_ratio(const TileValues<double>& height, int data_step) {
  double on_edge = 0.0;
  double off_edge = 0.0;
  int on = 0;
  int off = 0;
  const TileId& id = height.id;
  for (int j = id.first_j(); j <= id.first_j() + id.cells(); ++j) {
    for (int i = id.first_i(); i <= id.first_i() + id.cells(); ++i) {
      const double bend = std::abs(height.at(i - 1, j) - 2.0 * height.at(i, j) + height.at(i + 1, j));
      const bool edge = i % data_step == 0;
      (edge ? on_edge : off_edge) += bend;
      ++(edge ? on : off);
    }
  }
  return (on_edge / on) / (off_edge / off);
}

TEST(Ground, DataCellsLeaveNoCrease) {
  const auto surface = Surface::builtin(1);
  const TileId id = highest_tile(*surface, 13);
  EXPECT_LT(crease_ratio(surface->tile(id)->height, 1 << (13 - kBuiltinLevel)), 1.5);
  // The check sees a crease when there is one: fold the ground along the data's edges.
  TileValues<double> folded = surface->tile(id)->height;
  for (int j = id.first_j() - kTileGuard; j <= id.first_j() + id.cells() + kTileGuard; ++j) {
    for (int i = id.first_i() - kTileGuard; i <= id.first_i() + id.cells() + kTileGuard; ++i)
      folded.at(i, j) += 800.0 * std::abs((i + 8) % 16 - 8);
  }
  EXPECT_GT(crease_ratio(folded, 1 << (13 - kBuiltinLevel)), 1.5);
}

TEST(Ground, SlopesStayFiniteDownToFourCentimetreCells) {
  const auto surface = Surface::builtin(1);
  const ScenicView view = scenic_place(*surface);
  const dvec3 u = geo::normal_from_degrees(view.place.lat_deg, view.place.lon_deg);
  for (const int level : {17, 20, 24, 28}) {
    const Place place = locate(u, level);
    const TileId id = tile_of({place.d, level, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)});
    const auto tile = surface->tile(id);
    const TileValues<dvec3> directions = node_directions(id);
    double sum = 0.0;
    double steepest = 0.0;
    for (int j = id.first_j(); j <= id.first_j() + id.cells(); ++j) {
      for (int i = id.first_i(); i <= id.first_i() + id.cells(); ++i) {
        const double slope = glm::length(slope_at(*surface, *tile, directions, i, j).gradient);
        sum += slope;
        steepest = std::max(steepest, slope);
      }
    }
    EXPECT_GT(sum, 0.0);
    EXPECT_LT(sum / ((id.cells() + 1) * (id.cells() + 1)), 1.5) << level;
    EXPECT_LT(steepest, 6.0) << level;
  }
}

TEST(BuiltinPlanet, IsAboutThreeFifthsSeaWhateverTheSeed) {
  for (const std::uint64_t seed : {1u, 2u, 7u, 1000003u}) {
    const BuiltinPlanet planet(seed);
    int sea = 0;
    constexpr int kPlaces = 4000;
    for (int k = 0; k < kPlaces; ++k) {
      // Spiral points: even in area.
      const double z = 1.0 - (2.0 * k + 1.0) / kPlaces;
      const double r = std::sqrt(1.0 - z * z);
      const double turn = 2.399963229728653 * k;
      if (planet.at({r * std::cos(turn), r * std::sin(turn), z}).height_m < 0.0) ++sea;
    }
    EXPECT_GT(sea, kPlaces * 0.52) << seed;
    EXPECT_LT(sea, kPlaces * 0.70) << seed;
  }
}

TEST(BuiltinPlanet, DiffersFromSeedToSeed) {
  EXPECT_NE(BuiltinPlanet(1).at({0.6, 0.0, 0.8}).height_m, BuiltinPlanet(2).at({0.6, 0.0, 0.8}).height_m);
}

TEST(Albedo, StaysBetweenBlackAndSnow) {
  std::mt19937 random(2);
  const auto pick = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  for (int k = 0; k < 20000; ++k) {
    Ground g;
    g.height_m = pick(-9000.0, 9000.0);
    g.slope = {pick(-3.0, 3.0), pick(-3.0, 3.0)};
    g.cavity = pick(-3.0, 3.0);
    g.sin_latitude = pick(-1.0, 1.0);
    g.edge_m = std::exp2(pick(-5.0, 20.0));
    g.roughness = static_cast<float>(pick(-0.1, 1.2));
    g.prominence = static_cast<float>(pick(-1.0, 1.0));
    g.moisture = static_cast<float>(pick(0.0, 1.0));
    g.mottle = static_cast<float>(pick(-1.5, 1.5));
    g.color = glm::vec3(pick(0.0, 1.0), pick(0.0, 1.0), pick(0.0, 1.0));
    g.has_color = k % 2 == 0;
    g.has_sea = k % 3 == 0;
    g.airless = k % 5 == 0;
    const glm::vec3 color = albedo(g);
    for (const float c : {color.x, color.y, color.z}) {
      ASSERT_TRUE(c >= 0.0f && c <= 1.0f) << c;
    }
  }
}

TEST(Albedo, FollowsHeightSlopeAndMoistureWhereThereIsNoMap) {
  const auto bright = [](const Ground& g) {
    const glm::vec3 c = albedo(g);
    return (c.x + c.y + c.z) / 3.0f;
  };
  Ground meadow;
  meadow.height_m = 400.0;
  meadow.sin_latitude = 0.7;
  meadow.has_sea = true;
  Ground summit = meadow;
  summit.height_m = 5000.0;
  EXPECT_GT(bright(summit), 0.6f) << "snow";
  Ground cliff = summit;
  cliff.slope = {2.0, 0.0};  // 63 degrees
  EXPECT_LT(bright(cliff), 0.3f) << "no snow on cliffs";
  Ground desert = meadow;
  desert.moisture = 0.0f;
  Ground jungle = meadow;
  jungle.moisture = 1.0f;
  EXPECT_GT(bright(desert), 0.2f);
  EXPECT_LT(bright(jungle), 0.06f);
  Ground deep = meadow;
  deep.height_m = -4000.0;
  EXPECT_LT(bright(deep), 0.05f);
}

TEST(HeightAtHand, IsThatOfTheFinestLevelAlreadyMadeAndMakesNone) {
  const auto surface = Surface::builtin(3);
  const dvec3 u = geo::normal_from_degrees(-43.42, -106.43);
  const double coarse = surface->height(u, surface->data_level());
  EXPECT_EQ(surface->height_at_hand(u, 20), coarse);
  EXPECT_EQ(surface->height_at_hand(u, 20), coarse) << "asking must not make ground";
  const double at_14 = surface->height(u, 14);
  EXPECT_EQ(surface->height_at_hand(u, 20), at_14);
  EXPECT_EQ(surface->height_at_hand(u, 14), at_14);
  EXPECT_NE(at_14, coarse);
  const double at_20 = surface->height(u, 20);
  EXPECT_EQ(surface->height_at_hand(u, 20), at_20);
}

TEST(ScenicPlace, IsTheSameEveryTimeAndLooksAtHighGroundFromLand) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto surface = Surface::builtin(seed);
    const ScenicView view = scenic_place(*surface);
    const ScenicView again = scenic_place(*Surface::builtin(seed));
    EXPECT_EQ(view.place.lat_deg, again.place.lat_deg);
    EXPECT_EQ(view.place.lon_deg, again.place.lon_deg);
    EXPECT_EQ(view.heading_deg, again.heading_deg);
    EXPECT_GT(view.place.h_m, 0.0);
    EXPECT_LT(std::abs(view.place.lat_deg), 66.0);
    const geo::LocalFrame frame = geo::local_frame(view.place.lat_deg, view.place.lon_deg);
    const dvec3 ahead = geo::look_direction(frame, view.heading_deg, 0.0);
    double highest = 0.0;
    for (double distance = 5000.0; distance <= 60000.0; distance += 500.0) {
      const double angle = distance / surface->ellipsoid().mean_radius();
      highest = std::max(highest, surface->height(frame.up * std::cos(angle) + ahead * std::sin(angle), 12));
    }
    EXPECT_GT(highest, view.place.h_m + 700.0) << seed;
  }
}

}  // namespace
}  // namespace globe::planet
