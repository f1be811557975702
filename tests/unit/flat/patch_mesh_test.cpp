#include "flat/patch_mesh.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/vec3.hpp>
#include <map>
#include <random>

#include "tests/unit/flat/rough_ground.h"

namespace {

using namespace globe::flat;

struct Triangle {
  std::array<glm::dvec3, 3> corners;  ///< x and y in posts
};

/// The mesh of a region whose patches have such levels.
std::vector<Triangle> mesh_of(const Terrain& terrain, const std::vector<float>& levels) {
  std::vector<Triangle> triangles;
  for (std::size_t patch = 0; patch < terrain.patch_count(); ++patch) {
    const PatchState state = patch_state(levels, terrain.patches_east(), terrain.patches_north(), patch);
    const std::vector<PatchVertex> vertices = patch_vertices(terrain, patch, state);
    const auto east = static_cast<std::size_t>(terrain.patches_east());
    const double column = static_cast<double>(patch % east) * 16,
                 row = static_cast<double>(patch / east) * 16;
    const std::vector<std::uint16_t> indices = patch_indices(state.shape());
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      Triangle& triangle = triangles.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const PatchVertex& vertex = vertices[indices[k + c]];
        triangle.corners[c] = {column + vertex.column, row + vertex.row, morphed_z(vertex, state)};
      }
    }
  }
  return triangles;
}

std::vector<float> random_levels(std::mt19937& random, int east, int north) {
  std::uniform_int_distribution<int> any(0, 4096);
  std::vector<float> levels(static_cast<std::size_t>(east * north));
  for (float& level : levels) level = static_cast<float>(any(random)) * kLevelStep;
  limit_steps(levels, east, north);
  return levels;
}

using Corner = std::array<std::uint64_t, 3>;
Corner bits(const glm::dvec3& v) {
  return {std::bit_cast<std::uint64_t>(v.x), std::bit_cast<std::uint64_t>(v.y),
          std::bit_cast<std::uint64_t>(v.z)};
}

/// How often each edge is used, from one end to the other counted apart.
std::map<std::pair<Corner, Corner>, int> edges_of(const std::vector<Triangle>& triangles) {
  std::map<std::pair<Corner, Corner>, int> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++edges[{bits(t.corners[c]), bits(t.corners[(c + 1) % 3])}];
  }
  return edges;
}

int unmatched_inside(const std::vector<Triangle>& triangles, double last_x, double last_y) {
  const auto edges = edges_of(triangles);
  int unmatched = 0;
  for (const auto& [edge, count] : edges) {
    const auto x0 = std::bit_cast<double>(edge.first[0]), x1 = std::bit_cast<double>(edge.second[0]);
    const auto y0 = std::bit_cast<double>(edge.first[1]), y1 = std::bit_cast<double>(edge.second[1]);
    const bool on_rim =
        (x0 == x1 && (x0 == 0.0 || x0 == last_x)) || (y0 == y1 && (y0 == 0.0 || y0 == last_y));
    const auto back = edges.find({edge.second, edge.first});
    const int other = back == edges.end() ? 0 : back->second;
    if (count != 1 || other != (on_rim ? 0 : 1)) ++unmatched;
  }
  return unmatched;
}

TEST(PatchMesh, EveryInnerEdgeHasTwoTrianglesBitForBitWhateverTheLevels) {
  const auto terrain = rough_terrain(5, 4);
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    const std::vector<Triangle> mesh = mesh_of(*terrain, random_levels(random, 5, 4));
    EXPECT_EQ(unmatched_inside(mesh, 80, 64), 0);
    double area = 0.0;
    for (const Triangle& t : mesh) {
      const auto& [a, b, c] = t.corners;
      const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      EXPECT_GT(twice, 0.0);
      area += 0.5 * twice;
    }
    EXPECT_DOUBLE_EQ(area, 80.0 * 64.0);
  }
}

TEST(PatchMesh, WithoutAdaptedSidesItIsOpen) {
  const auto terrain = rough_terrain(2, 1);
  std::vector<Triangle> mesh = mesh_of(*terrain, {0.0f, 0.0f});
  const std::vector<Triangle> coarse = mesh_of(*terrain, {1.0f, 1.0f});
  std::erase_if(
      mesh, [](const Triangle& t) { return (t.corners[0].x + t.corners[1].x + t.corners[2].x) / 3 > 16; });
  for (const Triangle& t : coarse) {
    if ((t.corners[0].x + t.corners[1].x + t.corners[2].x) / 3 > 16) mesh.push_back(t);
  }
  EXPECT_GT(unmatched_inside(mesh, 32, 16), 0);
}

/// Heights of a mesh at every half post, by the triangle that lies there.
std::vector<double> surface_of(const std::vector<Triangle>& mesh, int columns, int rows) {
  std::vector<double> z(static_cast<std::size_t>((2 * columns - 1) * (2 * rows - 1)), NAN);
  for (const Triangle& t : mesh) {
    const auto& [a, b, c] = t.corners;
    const double x0 = std::min({a.x, b.x, c.x}), x1 = std::max({a.x, b.x, c.x});
    const double y0 = std::min({a.y, b.y, c.y}), y1 = std::max({a.y, b.y, c.y});
    const double det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    for (double y = y0; y <= y1; y += 0.5) {
      for (double x = x0; x <= x1; x += 0.5) {
        const double v = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / det;
        const double w = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / det;
        if (v < -1e-12 || w < -1e-12 || v + w > 1 + 1e-12) continue;
        z[static_cast<std::size_t>(2 * y * (2 * columns - 1) + 2 * x)] =
            a.z + v * (b.z - a.z) + w * (c.z - a.z);
      }
    }
  }
  return z;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

/// Levels that come ever nearer to whole numbers from below, and their ends.
TEST(PatchMesh, TheSurfaceChangesSteadilyWithTheLevelsOfAPatchAndOfItsNeighbours) {
  const auto terrain = rough_terrain(3, 3);
  std::mt19937 random(17);
  std::uniform_int_distribution<std::size_t> patch(0, 8);
  double pop = 0.0;
  for (int round = 0; round < 60; ++round) {
    std::vector<float> levels = random_levels(random, 3, 3);
    // Some patch passes a whole level, others near it too.
    for (int k = 0; k < 1 + round % 4; ++k) {
      float& level = levels[patch(random)];
      level = std::round(level);
    }
    limit_steps(levels, 3, 3);
    std::vector<float> below = levels;
    for (float& level : below) level = std::max(level - kLevelStep, 0.0f);
    limit_steps(below, 3, 3);
    const double moved =
        farthest(surface_of(mesh_of(*terrain, levels), 49, 49), surface_of(mesh_of(*terrain, below), 49, 49));
    // No vertex goes farther than the ground is rough, 620 m, over a whole level.
    EXPECT_LE(moved, 2.0 * 620.0 * static_cast<double>(kLevelStep));
    std::vector<float> whole = levels, whole_below = below;
    for (float& level : whole) level = std::floor(level);
    for (float& level : whole_below) level = std::floor(level);
    pop = std::max(pop, farthest(surface_of(mesh_of(*terrain, whole), 49, 49),
                                 surface_of(mesh_of(*terrain, whole_below), 49, 49)));
  }
  EXPECT_GT(pop, 20.0);  // metres, without morphing
}

TEST(PatchMesh, AMorphedPatchTurnsIntoTheNextLevel) {
  const auto terrain = rough_terrain(2, 2);
  for (int level = 0; level < kLevels - 1; ++level) {
    const auto almost = static_cast<float>(level + 1) - kLevelStep;
    const auto next = static_cast<float>(level + 1);
    const double apart = farthest(surface_of(mesh_of(*terrain, std::vector<float>(4, almost)), 33, 33),
                                  surface_of(mesh_of(*terrain, std::vector<float>(4, next)), 33, 33));
    EXPECT_LE(apart, 620.0 * static_cast<double>(kLevelStep)) << level;
  }
}

TEST(PatchMesh, TrianglesOfWholeLevelsAreThoseOfThePaper) {
  const std::array<std::size_t, kLevels> triangles{512, 128, 32, 8, 2};
  for (int level = 0; level < kLevels; ++level)
    EXPECT_EQ(patch_indices(level * 16).size() / 3, triangles[static_cast<std::size_t>(level)]);
}

}  // namespace
