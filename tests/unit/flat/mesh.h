#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "flat/patch_mesh.h"

using globe::flat::PatchState;
using globe::flat::PatchVertex;
using globe::flat::Terrain;

struct Triangle {
  std::array<glm::dvec3, 3> corners;  ///< x and y in posts
};

/// The mesh of a region whose patches have such levels.
inline std::vector<Triangle> mesh_of(const Terrain& terrain, const std::vector<float>& levels) {
  std::vector<Triangle> triangles;
  for (std::size_t patch = 0; patch < terrain.patch_count(); ++patch) {
    const PatchState state =
        globe::flat::patch_state(levels, terrain.patches_east(), terrain.patches_north(), patch);
    const std::vector<PatchVertex> vertices = patch_vertices(terrain, patch, state);
    const auto east = static_cast<std::size_t>(terrain.patches_east());
    const auto column = static_cast<double>(patch % east * 16);
    const auto row = static_cast<double>(patch / east * 16);
    const std::vector<std::uint16_t> indices = globe::flat::patch_indices(state.shape());
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

/// Heights of a mesh at every half post, by the triangle that lies there.
inline std::vector<double> surface_of(const std::vector<Triangle>& mesh, int columns, int rows) {
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
