#include "globe/clipmap/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <deque>
#include <map>
#include <random>
#include <set>

#include "globe/clipmap/morph.h"
#include "globe/clipmap/patch.h"
#include "globe/clipmap/settings.h"

namespace globe::clipmap {
namespace {

using Key = std::array<int, 3>;

Key key_of(const Node& node, int finest) {
  const auto key = planet::octahedral_key(node);
  const int up = finest - node.level;
  return {key.x << up, key.y << up, key.z << up};
}

bool full_run() { return std::getenv("GLOBE_TEST_FULL") != nullptr; }

/// Cameras on faces, and two thirds of them near the six octahedron corners; with the corners and edges
/// themselves.
std::vector<dvec3> cameras(int count) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<dvec3> result{{1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0},
                            {1, 1, 0}, {0, 1, 1}, {1, 1, 1},  {-1, 1, -1}};
  while (static_cast<int>(result.size()) < count) {
    dvec3 u{normal(random), normal(random), normal(random)};
    if (result.size() % 3 != 0) {
      const auto axis = static_cast<int>(result.size() % 6) / 2;
      u *= 0.15;
      u[axis] += result.size() % 2 == 0 ? 1.0 : -1.0;
    }
    result.push_back(u / std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z));
  }
  for (dvec3& u : result) u /= std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
  return result;
}

struct Levels {
  std::vector<Region> regions;
  std::vector<std::vector<Patch>> rings;
};

Levels make_levels(const Settings& settings, const dvec3& u, int count) {
  Levels levels;
  for (int k = 0; k < count; ++k)
    levels.regions.push_back(make_region(settings, nadir(u, settings.base_level + k)));
  for (std::size_t k = 0; k < levels.regions.size(); ++k) {
    const Region* next = k + 1 < levels.regions.size() ? &levels.regions[k + 1] : nullptr;
    levels.rings.push_back(make_ring(settings, levels.regions[k], next));
  }
  return levels;
}

std::set<std::pair<Key, Key>> rim_edges(const Region& region, int unit, int finest) {
  std::map<std::pair<Key, Key>, int> count;
  for (const LatticeTrixel& t : region.units) {
    const auto corners = t.corners();
    for (std::size_t a = 0; a < 3; ++a) {
      const ivec2 p = corners[a] * unit;
      const ivec2 q = corners[(a + 1) % 3] * unit;
      Key x = key_of({t.d, region.level, p.x, p.y}, finest);
      Key y = key_of({t.d, region.level, q.x, q.y}, finest);
      if (y < x) std::swap(x, y);
      ++count[{x, y}];
    }
  }
  std::set<std::pair<Key, Key>> rim;
  for (const auto& [edge, uses] : count) {
    if (uses == 1) rim.insert(edge);
  }
  return rim;
}

class RegionModel : public testing::TestWithParam<int> {};

/// DESIGN section 5 and its model, on our own code: the drawn mesh uses every edge exactly twice and is a
/// sphere.
TEST_P(RegionModel, MeshOfAllRingsIsClosedForEveryCamera) {
  const Settings settings = Settings::for_detail(GetParam());
  const PatchMesh mesh = make_patch_mesh(settings.m);
  const int levels = 4;
  const int finest = settings.base_level + levels - 1;
  for (const dvec3& u : cameras(full_run() ? 144 : 24)) {
    const Levels all = make_levels(settings, u, levels);
    std::map<std::pair<Key, Key>, int> edges;
    std::set<Key> vertices;
    long faces = 0;
    for (std::size_t k = 0; k < all.rings.size(); ++k) {
      for (const Patch& patch : all.rings[k]) {
        const auto& indices = mesh.indices[static_cast<std::size_t>(patch.rim)];
        for (std::size_t t = 0; t < indices.size(); t += 3) {
          std::array<Key, 3> v;
          for (std::size_t c = 0; c < 3; ++c) {
            const auto [a, b] = mesh.vertices[indices[t + c]];
            const ivec2 p = patch_node(patch.trixel, settings.m, a, b);
            v[c] = key_of({patch.trixel.d, settings.base_level + static_cast<int>(k), p.x, p.y}, finest);
            vertices.insert(v[c]);
          }
          for (std::size_t c = 0; c < 3; ++c) {
            const Key x = std::min(v[c], v[(c + 1) % 3]);
            const Key y = std::max(v[c], v[(c + 1) % 3]);
            ++edges[{x, y}];
          }
          ++faces;
        }
      }
    }
    for (const auto& [edge, uses] : edges) ASSERT_EQ(uses, 2) << "camera " << u.x << " " << u.y << " " << u.z;
    ASSERT_EQ(static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + faces, 2);
  }
}

TEST_P(RegionModel, RegionsNestWithoutTouchingAndFitTheirWindow) {
  const Settings settings = Settings::for_detail(GetParam());
  for (const dvec3& u : cameras(full_run() ? 144 : 48)) {
    const Levels all = make_levels(settings, u, 4);
    const int finest = settings.base_level + 3;
    for (std::size_t k = 1; k < all.regions.size(); ++k) {
      const Region& inner = all.regions[k];
      const Region& outer = all.regions[k - 1];
      std::set<Key> inner_nodes;
      for (const LatticeTrixel& t : inner.units) {
        // a unit of the finer level is a patch of the coarser one
        ASSERT_TRUE(outer.holds(coarser(t)));
        for (const ivec2& c : t.corners()) {
          inner_nodes.insert(
              key_of({t.d, inner.level, c.x * settings.unit(), c.y * settings.unit()}, finest));
        }
      }
      for (const auto& [a, b] : rim_edges(outer, settings.unit(), finest)) {
        if (outer.level == settings.base_level) break;
        ASSERT_FALSE(inner_nodes.contains(a));
        ASSERT_FALSE(inner_nodes.contains(b));
      }
      for (const NodeRect& rect : inner.nodes) {
        if (rect.empty()) continue;
        ASSERT_LE(rect.width(), 2 * settings.s + 1);
        ASSERT_LE(rect.height(), 2 * settings.s + 1);
      }
    }
  }
}

TEST_P(RegionModel, RimsAreWhollyMorphedAndHolesNotAtAll) {
  const Settings settings = Settings::for_detail(GetParam());
  const MorphBand band = morph_band(settings);
  for (const dvec3& u : cameras(full_run() ? 144 : 48)) {
    const Levels all = make_levels(settings, u, 4);
    for (std::size_t k = 1; k < all.regions.size(); ++k) {
      const int level = settings.base_level + static_cast<int>(k);
      const GridPoint fine = nadir(u, level);
      const GridPoint coarse = nadir(u, level - 1);
      const PatchMesh mesh = make_patch_mesh(settings.m);
      for (const Patch& patch : all.rings[k]) {
        if (patch.rim == 0) continue;
        const auto fine_images = images(fine, patch.trixel.d);
        const auto coarse_images = images(coarse, patch.trixel.d);
        for (const auto& [a, b] : mesh.vertices) {
          const bool on_rim = ((patch.rim & 1) != 0 && a + b == settings.m) ||
                              ((patch.rim & 2) != 0 && a == 0) || ((patch.rim & 4) != 0 && b == 0);
          if (!on_rim) continue;
          const ivec2 p = patch_node(patch.trixel, settings.m, a, b);
          ASSERT_EQ(morph_factor(band, hex_distance(fine_images, {p.x * kSubcell, p.y * kSubcell})), 1.0f);
          ASSERT_EQ(morph_factor(band, hex_distance(coarse_images, {p.x * kSubcell / 2, p.y * kSubcell / 2})),
                    0.0f);
        }
      }
    }
  }
}

TEST_P(RegionModel, EveryPatchAroundARimVertexKnowsThatItIsOne) {
  const Settings settings = Settings::for_detail(GetParam());
  const PatchMesh mesh = make_patch_mesh(settings.m);
  for (const dvec3& u : cameras(full_run() ? 144 : 24)) {
    const Region region = make_region(settings, nadir(u, settings.base_level + 2));
    std::map<Key, std::set<bool>> seen;  // vertex: whether patches take it from the coarser level
    for (const Patch& patch : make_ring(settings, region, nullptr)) {
      for (const auto& [a, b] : mesh.vertices) {
        const bool on_rim = ((patch.rim & 1) != 0 && a + b == settings.m) ||
                            ((patch.rim & 2) != 0 && a == 0) || ((patch.rim & 4) != 0 && b == 0) ||
                            ((patch.rim_corners & 1) != 0 && a + b == 0) ||
                            ((patch.rim_corners & 2) != 0 && a == settings.m) ||
                            ((patch.rim_corners & 4) != 0 && b == settings.m);
        const ivec2 p = patch_node(patch.trixel, settings.m, a, b);
        seen[key_of({patch.trixel.d, region.level, p.x, p.y}, region.level)].insert(on_rim);
      }
    }
    for (const auto& [vertex, ways] : seen) ASSERT_EQ(ways.size(), 1u);
  }
}

INSTANTIATE_TEST_SUITE_P(Details, RegionModel, testing::Values(16, 20, 28, 40, 64, 100));

/// The images' distance against a breadth-first search over the lattice, wherever it matters: within s cells.
TEST(HexDistance, IsTheLengthOfAShortestLatticePath) {
  const int level = 5;
  const int n = planet::nodes_per_side(level);
  for (const Node& start :
       {Node{0, level, 3, 2}, Node{1, level, 29, 1}, Node{2, level, 16, 16}, Node{3, level, 1, 30},
        Node{0, level, 0, 0}, Node{2, level, 31, 30}, Node{1, level, 0, 32}}) {
    std::map<Key, int> found;
    std::deque<Node> queue{start};
    found[key_of(start, level)] = 0;
    while (!queue.empty()) {
      const Node at = queue.front();
      queue.pop_front();
      const int distance = found[key_of(at, level)];
      const auto all = planet::names(at);
      for (int k = 0; k < all.count; ++k) {
        const Node& name = all.node[static_cast<std::size_t>(k)];
        for (const ivec2 step :
             {ivec2{1, 0}, ivec2{-1, 0}, ivec2{0, 1}, ivec2{0, -1}, ivec2{1, -1}, ivec2{-1, 1}}) {
          const Node next{name.d, level, name.i + step.x, name.j + step.y};
          if (next.i < 0 || next.j < 0 || next.i > n || next.j > n) continue;
          if (found.try_emplace(key_of(next, level), distance + 1).second) queue.push_back(next);
        }
      }
    }
    for (int d = 0; d < planet::kDiamonds; ++d) {
      const auto seen = images(grid_point(start), d);
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          const int truth = found[key_of({d, level, i, j}, level)];
          const auto ours = hex_distance(seen, {i * kSubcell, j * kSubcell}) / kSubcell;
          if (truth <= n / 2 || ours <= n / 2) {
            ASSERT_EQ(ours, truth) << d << " " << i << " " << j;
          }
        }
      }
    }
  }
}

TEST(PatchMesh, RimVariantsDropExactlyTheOddVerticesOfTheirEdges) {
  const PatchMesh mesh = make_patch_mesh(8);
  for (int rim = 0; rim < 8; ++rim) {
    std::set<std::array<std::uint8_t, 2>> used;
    for (const std::uint16_t index : mesh.indices[static_cast<std::size_t>(rim)])
      used.insert(mesh.vertices[index]);
    for (const auto& [a, b] : mesh.vertices) {
      const bool dropped = ((rim & 1) != 0 && a + b == 8 && a % 2 == 1) ||
                           ((rim & 2) != 0 && a == 0 && b % 2 == 1) ||
                           ((rim & 4) != 0 && b == 0 && a % 2 == 1);
      EXPECT_EQ(used.count({a, b}), dropped ? 0u : 1u);
    }
  }
}

TEST(FinestLevel, ChangesContinuouslyWithHeight) {
  const Settings settings = Settings::for_detail(64);
  double before = 0;
  for (double height = 1.0; height < 1e8; height *= 1.001) {
    const FinestLevel finest = finest_level(settings, 1e7, height, 26);
    const double shown =
        finest.level - static_cast<double>(finest.fade);  // fully faded level l looks like l - 1
    if (height > 1.0) {
      EXPECT_LT(std::abs(shown - before), 0.01) << height;
    }
    before = shown;
  }
}

}  // namespace
}  // namespace globe::clipmap
