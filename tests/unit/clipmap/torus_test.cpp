// The windows' addressing: no two nodes that a texture has to hold share a texel.

#include "globe/clipmap/torus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "globe/clipmap/footprint.h"
#include "globe/clipmap/region.h"
#include "globe/geo/ellipsoid.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace globe::clipmap {
namespace {

bool in_hexagon(int i, int j, int side) {
  return std::max({std::abs(i), std::abs(j), std::abs(i + j)}) <= side;
}

TEST(Torus, AHexagonLiesInItWhereverItsCentreIs) {
  std::mt19937 random(1);
  for (const int side : {1, 2, 3, 7, 16, 33}) {
    const Torus torus = Torus::hexagon(side);
    EXPECT_EQ(torus.width * torus.height, 3 * side * side + 4 * side + 1);
    for (int k = 0; k < 40; ++k) {
      const int ci = static_cast<int>(random() % 2001) - 1000, cj = static_cast<int>(random() % 2001) - 1000;
      std::set<std::pair<int, int>> texels;
      for (int j = -side; j <= side; ++j) {
        for (int i = -side; i <= side; ++i) {
          if (!in_hexagon(i, j, side)) continue;
          const glm::ivec2 t = torus.texel(ci + i, cj + j);
          ASSERT_TRUE(t.x >= 0 && t.x < torus.width && t.y >= 0 && t.y < torus.height);
          texels.insert({t.x, t.y});
        }
      }
      EXPECT_EQ(texels.size(), static_cast<std::size_t>(3 * side * side + 3 * side + 1));
    }
  }
}

NodeRect random_rect(std::mt19937& random, const Torus& torus) {
  const int i0 = static_cast<int>(random() % 400) - 100, j0 = static_cast<int>(random() % 400) - 100;
  return {i0, i0 + static_cast<int>(random()) % torus.width / 2, j0,
          j0 + static_cast<int>(random() % static_cast<unsigned>(2 * torus.height))};
}

TEST(Torus, PiecesHoldEveryNodeOnceAtItsTexel) {
  std::mt19937 random(2);
  for (const Torus& torus : {Torus::square(37), Torus::hexagon(17)}) {
    for (int k = 0; k < 300; ++k) {
      NodeRect rect = random_rect(random, torus);
      rect.i1 = std::min(std::max(rect.i1, rect.i0), rect.i0 + torus.width - 1);
      std::set<std::pair<int, int>> seen;
      for (const Torus::Piece& piece : torus.pieces(rect)) {
        EXPECT_FALSE(piece.nodes.empty());
        for (int j = piece.nodes.j0; j <= piece.nodes.j1; ++j) {
          for (int i = piece.nodes.i0; i <= piece.nodes.i1; ++i) {
            EXPECT_TRUE(seen.insert({i, j}).second);
            ASSERT_EQ(torus.texel(i, j), (Torus{torus.width, torus.height, 0}.texel(
                                             piece.x + i - piece.nodes.i0, piece.y + j - piece.nodes.j0)));
          }
        }
      }
      EXPECT_EQ(seen.size(),
                static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()));
    }
  }
}

using Texels = std::map<std::pair<int, int>, std::set<std::pair<int, int>>>;

void put(const Torus& torus, const std::vector<NodeRect>& rects, Texels& texels) {
  for (const NodeRect& rect : rects) {
    for (int j = rect.j0; j <= rect.j1; ++j) {
      for (int i = rect.i0; i <= rect.i1; ++i) {
        const glm::ivec2 t = torus.texel(i, j);
        texels[{t.x, t.y}].insert({i, j});
      }
    }
  }
}

/// Nodes that share a texel with another, by putting them there.
std::size_t clashes(const Torus& torus, const std::vector<NodeRect>& a, const std::vector<NodeRect>& b) {
  Texels texels;
  put(torus, a, texels);
  put(torus, b, texels);
  return static_cast<std::size_t>(
      std::count_if(texels.begin(), texels.end(), [](const auto& texel) { return texel.second.size() > 1; }));
}

TEST(Torus, KnowsWhatItHoldsTogether) {
  std::mt19937 random(3);
  std::size_t held = 0, not_held = 0;
  for (const Torus& torus : {Torus::square(37), Torus::hexagon(17), Torus{40, 21, 13}}) {
    for (int k = 0; k < 400; ++k) {
      std::vector<NodeRect> a, b;
      for (int r = 0; r < 2; ++r) {
        for (auto* set : {&a, &b}) {
          NodeRect rect = random_rect(random, torus);
          rect.i1 = rect.i0 + static_cast<int>(random() % 12);
          rect.j1 = rect.j0 + static_cast<int>(random() % 12);
          set->push_back(rect);
        }
      }
      const bool truth = clashes(torus, a, b) == 0;
      ASSERT_EQ(torus.holds_both(a, b), truth);
      ++(truth ? held : not_held);
    }
  }
  EXPECT_GT(held, 100u);
  EXPECT_GT(not_held, 100u);
}

TEST(NodeRects, DifferenceAndIntersectionOfSetsAreThoseOfTheirNodes) {
  std::mt19937 random(4);
  const auto random_set = [&] {
    std::vector<NodeRect> set;
    for (int k = 0; k < 4; ++k) {
      const int i = static_cast<int>(random() % 20), j = static_cast<int>(random() % 20);
      const NodeRect rect{i, i + static_cast<int>(random() % 8), j, j + static_cast<int>(random() % 8)};
      for (const NodeRect& part : difference(std::vector<NodeRect>{rect}, set)) set.push_back(part);
    }
    return set;
  };
  const auto count = [](const std::vector<NodeRect>& set, int i, int j) {
    return std::count_if(set.begin(), set.end(), [&](const NodeRect& rect) { return rect.holds(i, j); });
  };
  for (int k = 0; k < 300; ++k) {
    const auto a = random_set(), b = random_set();
    const auto minus = difference(a, b), both = intersect(a, b);
    for (int j = 0; j < 30; ++j) {
      for (int i = 0; i < 30; ++i) {
        const auto in_a = count(a, i, j), in_b = count(b, i, j);
        ASSERT_LE(in_a, 1);
        ASSERT_EQ(count(minus, i, j), in_a != 0 && in_b == 0 ? 1 : 0);
        ASSERT_EQ(count(both, i, j), in_a * in_b);
      }
    }
  }
}

/// Directions over random places, and close to the corners of the octahedron and the edges of diamonds.
std::vector<dvec3> hard_directions(std::size_t count) {
  std::mt19937_64 random(5);
  std::vector<dvec3> result;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  while (result.size() < count) {
    dvec3 u = hard::random_direction(random);
    const std::size_t kind = result.size() % 4;
    const double near = std::exp2(-16.0 * unit(random));
    if (kind == 1 || kind == 2) {  // a corner, a pole among them
      dvec3 corner(0.0);
      corner[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1.0 : -1.0;
      u = corner + near * u;
    } else if (kind == 3) {  // an edge
      u[static_cast<int>(random() % 3)] *= near;
    }
    result.push_back(glm::normalize(u));
  }
  return result;
}

/// A point one step of the regions' lattice away, in one of its three directions, if the diamond goes on so
/// far.
GridPoint a_step_from(GridPoint point, int cells, int direction) {
  const std::int64_t step = cells * kSubcell;
  const std::int64_t n = planet::nodes_per_side(point.level) * kSubcell;
  const auto moved = [&](std::int64_t x, std::int64_t by) { return std::clamp<std::int64_t>(x + by, 0, n); };
  point.at = {moved(point.at.i, direction % 3 == 1 ? 0 : step),
              moved(point.at.j, direction % 3 == 0   ? 0
                                : direction % 3 == 1 ? step
                                                     : -step)};
  return point;
}

class HexagonFootprint : public testing::TestWithParam<int> {};

TEST_P(HexagonFootprint, HoldsEveryNodeOfItsRegionOnTexelsOfTheirOwn) {
  Settings settings = Settings::for_detail(GetParam(), 0);
  settings.windows = Windows::kHexagon;
  const Torus torus = settings.vertex_torus();
  const Torus tight = Torus::hexagon(settings.s - 1);
  std::size_t clashing = 0, apart = 0, missing = 0, footprints = 0, needed = 0, held = 0, in_tight = 0,
              steps = 0;
  for (const dvec3& u : hard_directions(hard::full() ? 400 : 60)) {
    for (const int above : {1, 2, 3, 6, 14}) {
      const int level = settings.base_level + above;
      const GridPoint point = nadir(u, level);
      const Region region = make_region(settings, point);
      const Region next = make_region(settings, a_step_from(point, settings.unit(), above));
      for (int d = 0; d < planet::kDiamonds; ++d) {
        const std::vector<NodeRect> rects = footprint(settings, region, d);
        if (rects.empty()) continue;
        ++footprints;
        for (const NodeRect& rect : rects) {
          EXPECT_FALSE(rect.empty());
          EXPECT_EQ(intersect(rect, region.nodes[static_cast<std::size_t>(d)]), rect);
          held += static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
        }
        for (std::size_t a = 0; a < rects.size(); ++a) {
          for (std::size_t b = 0; b < a; ++b) EXPECT_TRUE(intersect(rects[a], rects[b]).empty());
        }
        for (const LatticeTrixel& unit : region.units) {
          if (unit.d != d) continue;
          for (const ivec2& corner : unit.corners()) {
            const ivec2 at = corner * settings.unit();
            ++needed;
            missing += std::none_of(rects.begin(), rects.end(),
                                    [&](const NodeRect& rect) { return rect.holds(at.x, at.y); });
          }
        }
        clashing += torus.holds_both(rects, {}) ? 0 : 1;
        in_tight += tight.holds_both(rects, {}) ? 0 : 1;
        const std::vector<NodeRect> after = footprint(settings, next, d);
        ++steps;
        apart += torus.holds_both(rects, after) ? 0 : 1;
      }
    }
  }
  hard::report("windows",
               "hexagon of detail " + std::to_string(GetParam()) +
                   ": footprints with nodes that share a texel, of " + std::to_string(footprints),
               "0", std::to_string(clashing));
  hard::report("windows", "negative control: a torus of side s - 1", "> 0", std::to_string(in_tight));
  hard::report("windows", "steps whose ends it does not hold together, of " + std::to_string(steps), "0.1 %",
               std::to_string(apart));
  EXPECT_EQ(clashing, 0u);
  EXPECT_EQ(missing, 0u);
  EXPECT_GT(in_tight, 0u);
  EXPECT_LE(1000 * apart,
            steps);  // by a corner of the octahedron now and then: such a step takes another layer
}

INSTANTIATE_TEST_SUITE_P(Details, HexagonFootprint, testing::Values(16, 20, 28, 64, 100));

}  // namespace
}  // namespace globe::clipmap
