#include "globe/planet/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "globe/htm/midpoint.h"
#include "globe/htm/trixel.h"

namespace globe::planet {
namespace {

std::vector<Node> all_nodes(int level) {
  std::vector<Node> all;
  const int n = nodes_per_side(level);
  for (int d = 0; d < kDiamonds; ++d)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) all.push_back({d, level, i, j});
  return all;
}

Node random_node(std::mt19937_64& random, int level) {
  const auto n = static_cast<std::uint64_t>(nodes_per_side(level));
  return {static_cast<int>(random() % kDiamonds), level, static_cast<int>(random() % (n + 1)),
          static_cast<int>(random() % (n + 1))};
}

Node random_border_node(std::mt19937_64& random, int level) {
  Node node = random_node(random, level);
  (random() % 2 == 0 ? node.i : node.j) = random() % 2 == 0 ? 0 : nodes_per_side(level);
  return node;
}

std::tuple<int, int, int> tuple_of(const ivec3& key) { return {key.x, key.y, key.z}; }

TEST(OctahedralKey, LiesOnTheOctahedron) {
  for (const Node& node : all_nodes(4)) {
    const ivec3 key = octahedral_key(node);
    EXPECT_EQ(std::abs(key.x) + std::abs(key.y) + std::abs(key.z), 16);
  }
}

TEST(OctahedralKey, OfTheCornersIsAnAxis) {
  EXPECT_EQ(octahedral_key({0, 3, 0, 0}), ivec3(0, 0, 8));
  EXPECT_EQ(octahedral_key({2, 3, 8, 8}), ivec3(0, 0, -8));
  EXPECT_EQ(octahedral_key({0, 3, 8, 0}), ivec3(8, 0, 0));
  EXPECT_EQ(octahedral_key({1, 3, 8, 0}), ivec3(0, 8, 0));
  EXPECT_EQ(octahedral_key({2, 3, 8, 0}), ivec3(-8, 0, 0));
  EXPECT_EQ(octahedral_key({3, 3, 8, 0}), ivec3(0, -8, 0));
  EXPECT_EQ(octahedral_key({3, 3, 0, 8}), ivec3(8, 0, 0));
}

TEST(OctahedralKey, IsEqualForAllNamesAndDifferentForAllOthers) {
  for (const int level : {0, 1, 2, 4}) {
    std::map<std::tuple<int, int, int>, std::set<std::tuple<int, int, int>>> nodes_of_key;
    for (const Node& node : all_nodes(level))
      nodes_of_key[tuple_of(octahedral_key(node))].insert({node.d, node.i, node.j});
    EXPECT_EQ(nodes_of_key.size(), 4u * (1u << (2 * level)) + 2u);
    for (const Node& node : all_nodes(level)) {
      const Names all = names(node);
      std::set<std::tuple<int, int, int>> named;
      for (int k = 0; k < all.count; ++k) {
        const Node& other = all.node[static_cast<std::size_t>(k)];
        named.insert({other.d, other.i, other.j});
      }
      EXPECT_EQ(named.size(), static_cast<std::size_t>(all.count));
      EXPECT_EQ(named, nodes_of_key[tuple_of(octahedral_key(node))]);
      EXPECT_EQ(all.node[0], node);
    }
  }
}

TEST(VertexKey, IsTheSameAtEveryLevelFromBirthOn) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    const int level = static_cast<int>(random() % 20);
    const Node node = random_node(random, level);
    const VertexKey key = vertex_key(node);
    EXPECT_LE(key.birth_level, level);
    EXPECT_EQ(vertex_key({node.d, level + 5, node.i << 5, node.j << 5}), key);
    EXPECT_EQ(key.key << (level - key.birth_level), octahedral_key(node));
  }
}

TEST(VertexHash, IsEqualForAllNamesAndTakesTheSeed) {
  std::mt19937_64 random(12);
  for (int trial = 0; trial < 1000; ++trial) {
    const Names all = names(random_border_node(random, 12));
    const auto hash = vertex_hash(7, vertex_key(all.node[0]).key);
    for (int k = 1; k < all.count; ++k)
      EXPECT_EQ(vertex_hash(7, vertex_key(all.node[static_cast<std::size_t>(k)]).key), hash);
    EXPECT_NE(vertex_hash(8, vertex_key(all.node[0]).key), hash);
  }
}

TEST(VertexHash, HasNoCollisionAmongAllVerticesOfLevel8) {
  std::set<std::uint64_t> hashes;
  std::set<std::tuple<int, int, int>> keys;
  for (const Node& node : all_nodes(8)) {
    hashes.insert(vertex_hash(1, octahedral_key(node)));
    keys.insert(tuple_of(octahedral_key(node)));
  }
  EXPECT_EQ(hashes.size(), keys.size());
}

TEST(NodeDirection, IsBitEqualFromEveryDiamond) {
  std::mt19937_64 random(13);
  for (int level = 0; level <= 29; ++level) {
    for (int trial = 0; trial < 200; ++trial) {
      const Names all = names(random_border_node(random, level));
      const dvec3 u = node_direction(all.node[0]);
      for (int k = 1; k < all.count; ++k) ASSERT_EQ(node_direction(all.node[static_cast<std::size_t>(k)]), u);
    }
  }
}

TEST(NodeDirection, OfAnOddNodeIsTheMidpointOfTheEdgeItHalves) {
  std::mt19937_64 random(14);
  for (int level = 1; level <= 29; ++level) {
    for (int trial = 0; trial < 200; ++trial) {
      const Node node = random_node(random, level);
      if (((node.i | node.j) & 1) == 0) continue;
      const auto [a, b] = halved_edge(node.i, node.j);
      // Both ends lie in the diamond: the edge is one of the coarser level's.
      const int n = nodes_per_side(level);
      for (const ivec2& end : {a, b}) {
        ASSERT_EQ((end.x | end.y) & 1, 0);
        ASSERT_TRUE(std::min(end.x, end.y) >= 0 && std::max(end.x, end.y) <= n);
      }
      ASSERT_EQ(node_direction(node), htm::midpoint(node_direction({node.d, level, a.x, a.y}),
                                                    node_direction({node.d, level, b.x, b.y})));
    }
  }
}

TEST(HalvedEdge, IsTheAverageOfItsEnds) {
  for (const auto& [i, j] : {std::pair{3, 4}, {4, 3}, {5, 7}, {1, 0}, {0, 1}, {1, 1}}) {
    const auto [a, b] = halved_edge(i, j);
    EXPECT_EQ(a + b, ivec2(2 * i, 2 * j));
  }
}

TEST(Fold, LeavesPlacesInsideAlone) {
  for (const Node& node : all_nodes(3)) EXPECT_EQ(fold(node), node);
}

TEST(Fold, MovesOneStepOverAnEdgeToALatticeNeighbour) {
  // Inside, the six lattice neighbours of a node are at (±1, 0), (0, ±1), (1, -1), (-1, 1). Over an edge the
  // folded neighbour must be one of the lattice neighbours that the node has under its other names.
  constexpr std::array<ivec2, 6> kSteps{ivec2{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
  const int level = 3;
  const int n = nodes_per_side(level);
  for (const Node& node : all_nodes(level)) {
    std::set<std::tuple<int, int, int>> around;
    const Names all = names(node);
    for (int k = 0; k < all.count; ++k) {
      const Node& name = all.node[static_cast<std::size_t>(k)];
      for (const ivec2& step : kSteps) {
        const Node next{name.d, level, name.i + step.x, name.j + step.y};
        if (std::min(next.i, next.j) >= 0 && std::max(next.i, next.j) <= n)
          around.insert(tuple_of(octahedral_key(next)));
      }
    }
    std::set<std::tuple<int, int, int>> folded;
    for (const ivec2& step : kSteps) {
      const Node next = fold({node.d, level, node.i + step.x, node.j + step.y});
      ASSERT_TRUE(std::min(next.i, next.j) >= 0 && std::max(next.i, next.j) <= n);
      folded.insert(tuple_of(octahedral_key(next)));
    }
    // Six neighbours at ordinary nodes, four at the octahedron's corners; fold reaches each of them.
    EXPECT_EQ(folded, around) << node.d << ' ' << node.i << ' ' << node.j;
  }
}

TEST(Fold, CarriesPlacesFarOverOneEdgeToTheUnfoldedNeighbour) {
  // Over edge j = 0 the neighbour d - 1 is turned by 60 degrees about the pole in which the edge ends. The
  // lattice distance from a node on the edge must not change.
  const int level = 4;
  const int n = nodes_per_side(level);
  for (int d = 0; d < kDiamonds; ++d) {
    for (int i = 1; i < n; ++i) {
      for (int over = 1; over <= i; ++over) {
        const Node there = fold({d, level, i, -over});
        ASSERT_EQ(there.d, (d + 3) % 4);
        // (0, t) of d - 1 is (t, 0) of d: distance from the edge and along it.
        EXPECT_EQ(there.i, over);
        EXPECT_EQ(there.j, i - over);
      }
    }
  }
}

TEST(Locate, InvertsNodeDirection) {
  std::mt19937_64 random(15);
  // In cells: the direction is good to 2e-16, a cell of level L is about 1.6 / 2^L.
  for (int level = 0; level <= 28; ++level) {
    const double tolerance = 1e-14 + 4e-16 * nodes_per_side(level);
    for (int trial = 0; trial < 500; ++trial) {
      const Node node = random_node(random, level);
      const Place place = locate(node_direction(node), level);
      bool found = false;
      const Names all = names(node);
      for (int k = 0; k < all.count; ++k) {
        const Node& name = all.node[static_cast<std::size_t>(k)];
        found |= name.d == place.d && std::abs(place.ij.x - name.i) <= tolerance &&
                 std::abs(place.ij.y - name.j) <= tolerance;
      }
      ASSERT_TRUE(found) << "level " << level << " d " << node.d << " i " << node.i << " j " << node.j
                         << " gave d " << place.d << " i " << place.ij.x << " j " << place.ij.y;
    }
  }
}

TEST(Locate, IsAffineInTheFlatTrixel) {
  std::mt19937_64 random(16);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    const int level = static_cast<int>(random() % 12);
    const int n = nodes_per_side(level);
    const Node node{static_cast<int>(random() % 4), level, static_cast<int>(random()) & (n - 1),
                    static_cast<int>(random()) & (n - 1)};
    double s = unit(random), t = unit(random);
    if (s + t > 1.0) {
      s = 1.0 - s;
      t = 1.0 - t;
    }
    const dvec3 a = node_direction(node);
    const dvec3 b = node_direction({node.d, level, node.i + 1, node.j});
    const dvec3 c = node_direction({node.d, level, node.i, node.j + 1});
    const Place place = locate(glm::normalize(a + s * (b - a) + t * (c - a)), level);
    ASSERT_EQ(place.d, node.d);
    EXPECT_NEAR(place.ij.x, node.i + s, 1e-11);
    EXPECT_NEAR(place.ij.y, node.j + t, 1e-11);
  }
}

TEST(HexLength, IsTheShortestLatticePath) {
  EXPECT_EQ(hex_length(0, 0), 0);
  EXPECT_EQ(hex_length(3, -3), 3);
  EXPECT_EQ(hex_length(3, 2), 5);
  EXPECT_EQ(hex_length(-4, 1), 4);
  EXPECT_DOUBLE_EQ(hex_length(0.5, 0.25), 0.75);
}

}  // namespace
}  // namespace globe::planet
