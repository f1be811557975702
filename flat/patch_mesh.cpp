#include "flat/patch_mesh.h"

#include <glm/vec4.hpp>

#include "flat/cell.h"

namespace globe::flat {
namespace {

namespace shader {
using namespace glm;
#define precise
#include "shaders/flat/geomorph.glsl"
#undef precise
}  // namespace shader

glm::vec4 as_vector(const std::array<float, kSides>& values) {
  return {values[0], values[1], values[2], values[3]};
}

/// Heights of a patch at its level's posts, 0 to n each way.
struct Posts {
  const Terrain& terrain;
  int first_column, first_row, step, n;

  float z(int i, int j) const { return terrain.z(first_column + i * step, first_row + j * step); }
  float mean(int i0, int j0, int i1, int j1) const { return 0.5f * (z(i0, j0) + z(i1, j1)); }
};

/// Along a side: the post `along` it, from the south or the west.
float side_z(const Posts& posts, std::size_t side, int along) {
  switch (side) {
    case kWest:
      return posts.z(0, along);
    case kEast:
      return posts.z(posts.n, along);
    case kSouth:
      return posts.z(along, 0);
    default:
      return posts.z(along, posts.n);
  }
}

/// How far a side's vertex moves as the side turns into the next coarser one; 0 where it stays.
float side_move(const Posts& posts, std::size_t side, bool coarser, int along) {
  const int reach = coarser ? 2 : 1;
  if (along % (2 * reach) != reach || along + reach > posts.n) return 0.0f;
  return 0.5f * (side_z(posts, side, along - reach) + side_z(posts, side, along + reach)) -
         side_z(posts, side, along);
}

void set_inner(const Posts& posts, const PatchState& state, int i, int j, PatchVertex& vertex) {
  if (i % 2 == 1 && j % 2 == 1) {
    const bool north_east = splits_north_east(i / 2, j / 2);
    vertex.self =
        (north_east ? posts.mean(i - 1, j - 1, i + 1, j + 1) : posts.mean(i - 1, j + 1, i + 1, j - 1)) -
        vertex.z;  // the ends of a coarse diagonal rest: on a side they are even in the next level too
    return;
  }
  if (i % 2 == 0 && j % 2 == 0) return;
  const bool across = i % 2 == 1;
  vertex.self = (across ? posts.mean(i - 1, j, i + 1, j) : posts.mean(i, j - 1, i, j + 1)) - vertex.z;
  // An end on a side that is coarser by a level moves with that side, and half of it comes along: height is
  // bilinear in the two shares, which side and self alone cannot give.
  const auto follow = [&](std::size_t side, bool beside, int along) {
    if (!beside || !state.coarser[side]) return;
    const float move = 0.5f * side_move(posts, side, true, along);
    vertex.self += move;
    vertex.both[side] = -move;
  };
  follow(kWest, across && i == 1, j);
  follow(kEast, across && i == posts.n - 1, j);
  follow(kSouth, !across && j == 1, i);
  follow(kNorth, !across && j == posts.n - 1, i);
}

}  // namespace

std::vector<PatchVertex> patch_vertices(const Terrain& terrain, std::size_t patch, const PatchState& state) {
  const auto east = static_cast<std::size_t>(terrain.patches_east());
  const Posts posts{terrain, static_cast<int>(patch % east) * kPatchCells,
                    static_cast<int>(patch / east) * kPatchCells, 1 << state.level,
                    kPatchCells >> state.level};
  std::vector<PatchVertex> vertices;
  vertices.reserve(static_cast<std::size_t>(posts.n + 1) * static_cast<std::size_t>(posts.n + 1));
  for (int j = 0; j <= posts.n; ++j) {
    for (int i = 0; i <= posts.n; ++i) {
      PatchVertex& vertex = vertices.emplace_back();
      vertex.column = static_cast<std::uint8_t>(i * posts.step);
      vertex.row = static_cast<std::uint8_t>(j * posts.step);
      vertex.z = posts.z(i, j);
      const bool on_side_ns = j == 0 || j == posts.n;
      const bool on_side_we = i == 0 || i == posts.n;
      if (on_side_ns && on_side_we) continue;  // a corner rests
      if (on_side_we || on_side_ns) {
        const std::size_t side = on_side_we ? (i == 0 ? kWest : kEast) : (j == 0 ? kSouth : kNorth);
        vertex.side[side] = side_move(posts, side, state.coarser[side], on_side_we ? j : i);
      } else {
        set_inner(posts, state, i, j, vertex);
      }
    }
  }
  return vertices;
}

float morphed_z(const PatchVertex& vertex, const PatchState& state) {
  return shader::geomorph(vertex.z, vertex.self, as_vector(vertex.side), as_vector(vertex.both), state.morph,
                          as_vector(state.side_morph));
}

std::vector<std::uint16_t> patch_indices(int shape) {
  const int n = kPatchCells >> (shape / 16);
  // On a coarser side an odd vertex lies between two triangles of one inner vertex: it goes into its even
  // neighbour, one of the two triangles becomes both, the other nothing.
  const auto vertex = [&](int i, int j) {
    if (((shape & 1) != 0 && i == 0) || ((shape & 2) != 0 && i == n)) j += j % 2;
    if (((shape & 4) != 0 && j == 0) || ((shape & 8) != 0 && j == n)) i += i % 2;
    return static_cast<std::uint16_t>(j * (n + 1) + i);
  };
  std::vector<std::uint16_t> indices;
  const auto add = [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    if (a != b && b != c && c != a) indices.insert(indices.end(), {a, b, c});
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::uint16_t sw = vertex(i, j), se = vertex(i + 1, j), nw = vertex(i, j + 1),
                          ne = vertex(i + 1, j + 1);
      split_cell(splits_north_east(i, j), sw, se, nw, ne, add);
    }
  }
  return indices;
}

}  // namespace globe::flat
