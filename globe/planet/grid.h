#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace globe::planet {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

inline constexpr int kDiamonds = 4;
inline constexpr int kMaxLevel = 29;  ///< grid coordinates stay in 32-bit integers

/// A node of the diamond grid: diamond d (0..3), level L, 0 <= i, j <= n = 2^L.
///
/// Diamond d covers longitudes [90d°, 90(d+1)°]; it is trixel N(3-d) joined to S(d) along the equator. The
/// north pole is (0, 0), the western equatorial corner (n, 0), the eastern one (0, n), the south pole (n, n).
/// Each cell is two level-L trixels, split along the anti-diagonal (i+1, j) - (i, j+1). Every node is an HTM
/// vertex of level L.
struct Node {
  int d = 0;
  int level = 0;
  int i = 0;
  int j = 0;

  friend bool operator==(const Node&, const Node&) = default;
};

inline int nodes_per_side(int level) { return 1 << level; }

/// Identity of a node, the same from every diamond that holds it: octahedral integers (x, y, z) with
/// |x| + |y| + |z| = 2^level, +x at longitude 0, +y at 90, +z at the north pole (DESIGN section 4).
ivec3 octahedral_key(const Node& node);

/// The key with common factors of two removed, and the level at which the vertex was born.
struct VertexKey {
  ivec3 key;
  int birth_level;

  friend bool operator==(const VertexKey&, const VertexKey&) = default;
};
VertexKey vertex_key(const Node& node);

/// A well-mixed 64-bit hash of (seed, vertex): equal for every name of the same vertex.
std::uint64_t vertex_hash(std::uint64_t seed, const ivec3& octahedral_key);

/// Geodetic normal of a node: the HTM vertex, computed by halving edges only; bit-identical from every
/// diamond. Costs one walk of `level` steps; runs of nodes come cheaper from a tile (directions.h).
dvec3 node_direction(const Node& node);

/// The node a plane coordinate means when the lattice of diamond d is continued over its edges.
///
/// (i, j) may lie outside [0, n]: across an edge the lattice is unfolded into the neighbour (turned by 60
/// degrees about the pole the edge ends in), repeatedly if need be. Around an octahedron corner only four of
/// the six sectors of the plane exist, so places behind a corner are reached by two coordinates.
Node fold(const Node& plane);

/// Neighbours of a node in the lattice, in order around it; two that follow one another make a trixel with
/// it.
inline constexpr std::array<ivec2, 6> kLatticeSteps{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};

/// The other names of a node that lies on a diamond's border: itself first. `count` of the array are valid.
struct Names {
  std::array<Node, 4> node;
  int count;
};
Names names(const Node& node);

/// The two level-(L-1) nodes whose edge the node halves, as level-L coordinates of the same diamond; the node
/// must have an odd coordinate. (i odd, j even): (i±1, j); (even, odd): (i, j±1); both odd: (i+1, j-1), (i-1,
/// j+1).
std::array<ivec2, 2> halved_edge(int i, int j);

/// Length of the shortest lattice path between two plane coordinates of one diamond, cells:
/// max(|Δi|, |Δj|, |Δi + Δj|).
template <typename T>
T hex_length(T di, T dj) {
  const T a = di < 0 ? -di : di;
  const T b = dj < 0 ? -dj : dj;
  const T sum = di + dj;
  const T c = sum < 0 ? -sum : sum;
  const T ab = a > b ? a : b;
  return ab > c ? ab : c;
}

/// Where a direction lies in the grid: diamond and continuous plane coordinates at a level, affine inside the
/// level-L trixel that holds it (the flat triangle is intersected by the ray from the centre).
struct Place {
  int d = 0;
  int level = 0;
  dvec2 ij{0.0};  ///< 0 .. 2^level
};
Place locate(const dvec3& u, int level);

}  // namespace globe::planet
