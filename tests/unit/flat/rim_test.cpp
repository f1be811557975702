#include "flat/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <utility>

#include "tests/unit/flat/rough_ground.h"

namespace {

using namespace globe::flat;

/// Ground around a region: a surface of the frame given in the plane, cut at places that have nothing to do
/// with the posts.
double around_z(double x, double y) {
  return 500.0 + 0.05 * x - 0.02 * y + 40.0 * std::sin(x * 0.003 + y * 0.002);
}

Cutter cutter_of(const Terrain& terrain) {
  return [&terrain](const globe::clipmap::CuttingPlane& plane) {
    const dvec3 centre = terrain.frame().local_from_ecef(plane.centre);
    const dvec3 normal = plane.normal * terrain.frame().axes();
    const dvec3 along(std::abs(normal.y), std::abs(normal.x), 0.0);
    std::vector<std::array<dvec3, 2>> segments;
    for (double t = -plane.radius; t < plane.radius; t += 71.3) {
      std::array<dvec3, 2> ends;
      for (std::size_t k = 0; k < 2; ++k) {
        const dvec3 at = centre + along * (t + 71.3 * static_cast<double>(k));
        ends[k] = terrain.frame().ecef_from_local({at.x, at.y, around_z(at.x, at.y)});
      }
      segments.push_back(ends);
    }
    return segments;
  };
}

std::vector<float> random_levels(const Terrain& terrain, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> step(0, 4 * 1024);
  std::vector<float> levels(terrain.patch_count());
  for (float& level : levels) level = static_cast<float>(step(random)) * kLevelStep;
  limit_steps(levels, terrain.patches_east(), terrain.patches_north());
  return levels;
}

struct Collar {
  std::vector<CollarVertex> vertices;               ///< three a triangle
  std::map<std::pair<float, float>, float> border;  ///< z of the region's border, not lifted yet
};

Collar collar_of(const Terrain& terrain, const Rim& rim, const std::vector<float>& levels) {
  Collar collar;
  for (std::size_t patch = 0; patch < terrain.patch_count(); ++patch) {
    if (!is_at_border(terrain, patch)) continue;
    const PatchState state = patch_state(levels, terrain.patches_east(), terrain.patches_north(), patch);
    add_collar(terrain, rim, {patch, state, patch_vertices(terrain, patch, state)}, true, {0.0, 0.0},
               collar.vertices);
  }
  return collar;
}

using Edge = std::pair<std::array<float, 3>, std::array<float, 3>>;
std::array<float, 3> key(const CollarVertex& v) { return {v.post.x, v.post.y, v.z}; }

TEST(FlatRim, TheCollarIsClosedBetweenTheBorderAndTheGroundAround) {
  const auto terrain = rough_terrain(4, 3);
  const Rim rim = make_rim(*terrain, cutter_of(*terrain));
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Collar collar = collar_of(*terrain, rim, random_levels(*terrain, seed));
    // An edge that only one triangle has lies on the border or on the outer edge, never between.
    std::map<Edge, int> uses;
    double area = 0.0;
    for (std::size_t k = 0; k < collar.vertices.size(); k += 3) {
      const CollarVertex* v = &collar.vertices[k];
      const glm::dvec2 a(v[0].post), b(v[1].post), c(v[2].post);
      const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      EXPECT_GT(twice, 0.0);  // counter-clockwise from above
      area += 0.5 * twice;
      for (int e = 0; e < 3; ++e) {
        Edge edge{key(v[e]), key(v[(e + 1) % 3])};
        if (edge.second < edge.first) std::swap(edge.first, edge.second);
        ++uses[edge];
      }
    }
    const double columns = terrain->posts().columns - 1, rows = terrain->posts().rows - 1;
    EXPECT_NEAR(area, (columns + 2) * (rows + 2) - columns * rows, 1e-3);
    const auto is_outer = [&](const std::array<float, 3>& p) {
      return p[0] == -1.0f || p[1] == -1.0f || p[0] == static_cast<float>(columns) + 1.0f ||
             p[1] == static_cast<float>(rows) + 1.0f;
    };
    for (const auto& [edge, count] : uses) {
      ASSERT_LE(count, 2);
      if (count == 1) {
        ASSERT_EQ(is_outer(edge.first), is_outer(edge.second));
      }
    }
  }
}

TEST(FlatRim, TheCollarsOuterEdgeIsTheGroundAround) {
  const auto terrain = rough_terrain(4, 3);
  const Rim rim = make_rim(*terrain, cutter_of(*terrain));
  const Collar collar = collar_of(*terrain, rim, std::vector<float>(terrain->patch_count(), 2.0f));
  int outer = 0;
  for (const CollarVertex& v : collar.vertices) {
    if (v.lifted != 0.0f) continue;
    ++outer;
    const double x = terrain->x_m(0) + static_cast<double>(v.post.x) * terrain->spacing_m();
    const double y = terrain->y_m(0) + static_cast<double>(v.post.y) * terrain->spacing_m();
    // Between the ends of a stretch the ground around is straight.
    EXPECT_NEAR(static_cast<double>(v.z), around_z(x, y), 0.25);
  }
  EXPECT_GT(outer, 100);
}

TEST(FlatRim, ABorderPostIsLiftedToTheGroundAroundAndInnerOnesNotAtAll) {
  const auto terrain = rough_terrain(6, 6);
  const PostRect& posts = terrain->posts();
  const Rim rim = make_rim(*terrain, cutter_of(*terrain));
  const auto lifted = [&](int column, int row) {
    return static_cast<double>(terrain->z(column, row) + lift_at(rim, posts, column, row));
  };
  for (int k = 0; k < posts.columns; ++k) {
    for (const auto& [column, row] :
         {std::pair(k, 0), std::pair(k, posts.rows - 1), std::pair(0, k), std::pair(posts.columns - 1, k)})
      EXPECT_NEAR(lifted(column, row), around_z(terrain->x_m(column), terrain->y_m(row)), 0.3);
  }
  double steepest = 0.0;
  for (int column = 1; column < posts.columns; ++column)
    steepest = std::max(steepest, static_cast<double>(std::abs(lift_at(rim, posts, column, 40) -
                                                               lift_at(rim, posts, column - 1, 40))));
  EXPECT_LT(steepest, rim.highest_m / 8.0);  // no step on the way in
  EXPECT_EQ(lift_at(rim, posts, posts.columns / 2, posts.rows / 2), 0.0f);
}

TEST(FlatRim, ACurveIsLinearBetweenItsPointsAndLevelBeyond) {
  const RimCurve curve({{10.0, 4.0}, {0.0, 2.0}, {10.0, 4.0}, {20.0, 0.0}});
  EXPECT_EQ(curve.points().size(), 3u);
  EXPECT_DOUBLE_EQ(curve.z_at(5.0), 3.0);
  EXPECT_DOUBLE_EQ(curve.z_at(15.0), 2.0);
  EXPECT_DOUBLE_EQ(curve.z_at(-5.0), 2.0);
  EXPECT_DOUBLE_EQ(curve.z_at(25.0), 0.0);
}

TEST(FlatRim, TheRoomIsTheRegionAndItsCollar) {
  const auto terrain = rough_terrain(2, 2);
  const globe::render::Room room = room_of(*terrain);
  const double half = (0.5 * (terrain->posts().columns - 1) + kCollarPosts) * terrain->spacing_m();
  const dvec3 just_in = terrain->frame().ecef_from_local({half - 0.5, 0.0, 800.0});
  const glm::dvec4 inside = room.inside_m(just_in);
  EXPECT_NEAR(inside.y, 0.5, 1e-6);
  EXPECT_NEAR(inside.z, half, 1e-6);
  using globe::render::RoomSide;
  const dvec3 middle = terrain->frame().ecef_from_local({0.0, 0.0, 800.0});
  EXPECT_EQ(side_of(room, middle, 100.0), RoomSide::kInside);
  EXPECT_EQ(side_of(room, just_in, 100.0), RoomSide::kAcross);
  EXPECT_EQ(side_of(room, terrain->frame().ecef_from_local({2.0 * half, 0.0, 800.0}), 100.0),
            RoomSide::kOutside);
  EXPECT_EQ(side_of(room, -middle, 100.0), RoomSide::kOutside);  // the other side of the planet
}

}  // namespace
