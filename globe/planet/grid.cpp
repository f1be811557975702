#include "globe/planet/grid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>

#include "globe/htm/midpoint.h"

namespace globe::planet {
namespace {

/// Axis at the western corner of diamond d; the eastern one is that of d + 1.
constexpr std::array<ivec2, 4> kEquatorAxes{ivec2{1, 0}, ivec2{0, 1}, ivec2{-1, 0}, ivec2{0, -1}};

struct Corner {
  ivec2 ij;
  dvec3 u;
};

/// The level-0 trixel of diamond d (its northern or southern half) as grid corners at level L, in the order
/// (right angle of the lattice triangle, end along i, end along j).
std::array<Corner, 3> root_corners(int d, bool north, int n) {
  const ivec2 west = kEquatorAxes[static_cast<std::size_t>(d)];
  const ivec2 east = kEquatorAxes[static_cast<std::size_t>((d + 1) % kDiamonds)];
  const dvec3 w{west.x, west.y, 0.0};
  const dvec3 e{east.x, east.y, 0.0};
  if (north) return {Corner{{0, 0}, {0, 0, 1}}, Corner{{n, 0}, w}, Corner{{0, n}, e}};
  return {Corner{{n, n}, {0, 0, -1}}, Corner{{0, n}, e}, Corner{{n, 0}, w}};
}

double determinant(const dvec3& a, const dvec3& b, const dvec3& p) {
  return glm::dot(glm::cross(a - p, b - p), p);
}

int wrap_diamond(int d) { return (d % kDiamonds + kDiamonds) % kDiamonds; }

}  // namespace

ivec3 octahedral_key(const Node& node) {
  const int n = nodes_per_side(node.level);
  const bool north = node.i + node.j <= n;
  const int w = north ? node.i : n - node.j;
  const int e = north ? node.j : n - node.i;
  const int z = n - node.i - node.j;
  const ivec2 a = kEquatorAxes[static_cast<std::size_t>(node.d)];
  const ivec2 b = kEquatorAxes[static_cast<std::size_t>((node.d + 1) % kDiamonds)];
  return {w * a.x + e * b.x, w * a.y + e * b.y, z};
}

VertexKey vertex_key(const Node& node) {
  const ivec3 key = octahedral_key(node);
  const auto bits = static_cast<unsigned>(key.x | key.y | key.z);
  const int shift = std::min(std::countr_zero(bits), node.level);
  return {{key.x >> shift, key.y >> shift, key.z >> shift}, node.level - shift};
}

std::uint64_t vertex_hash(std::uint64_t seed, const ivec3& key) {
  // Two rounds of a 64-bit finaliser (Stafford's mix 13, as in splitmix64) over the packed key: 31 bits a
  // coordinate do not fit one word, so x and y go in first.
  const auto mix = [](std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  };
  const auto word = [](int v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)); };
  return mix(mix(seed + 0x9e3779b97f4a7c15ULL + (word(key.x) << 32 | word(key.y))) ^ word(key.z));
}

dvec3 node_direction(const Node& node) {
  const int n = nodes_per_side(node.level);
  assert(node.i >= 0 && node.i <= n && node.j >= 0 && node.j <= n);
  const ivec2 p{node.i, node.j};
  std::array<Corner, 3> t = root_corners(node.d, node.i + node.j <= n, n);
  for (;;) {
    for (const Corner& corner : t) {
      if (corner.ij == p) return corner.u;
    }
    const auto halve = [](const Corner& a, const Corner& b) {
      return Corner{(a.ij + b.ij) / 2, htm::midpoint(a.u, b.u)};
    };
    const std::array<Corner, 3> mid{halve(t[1], t[2]), halve(t[2], t[0]), halve(t[0], t[1])};
    // The corner whose quarter holds p, if any, else the middle trixel: compare lattice distances from each
    // corner, which along the triangle's own axes are the barycentric weights.
    const int side = std::abs(t[1].ij.x - t[0].ij.x) + std::abs(t[1].ij.y - t[0].ij.y);
    const int sign = t[1].ij.x > t[0].ij.x || t[2].ij.y > t[0].ij.y ? 1 : -1;
    const ivec2 q = sign * (p - t[0].ij);  // q.x along one axis, q.y along the other, q.x + q.y <= side
    const int half = side / 2;
    if (q.x + q.y <= half) {
      t = {t[0], mid[2], mid[1]};
    } else if (q.x >= half) {
      t = {mid[2], t[1], mid[0]};
    } else if (q.y >= half) {
      t = {mid[1], mid[0], t[2]};
    } else {
      t = {mid[0], mid[1], mid[2]};
    }
  }
}

Node fold(const Node& plane) {
  const int n = nodes_per_side(plane.level);
  Node p = plane;
  for (int turn = 0; turn < 8; ++turn) {
    const int a = n - p.i;
    const int b = n - p.j;
    if (p.j < 0) {
      p = {wrap_diamond(p.d - 1), p.level, -p.j, p.i + p.j};
    } else if (p.i < 0) {
      p = {wrap_diamond(p.d + 1), p.level, p.i + p.j, -p.i};
    } else if (b < 0) {
      p = {wrap_diamond(p.d + 1), p.level, n + b, n - (a + b)};
    } else if (a < 0) {
      p = {wrap_diamond(p.d - 1), p.level, n - (a + b), n + a};
    } else {
      return p;
    }
  }
  assert(false && "fold: coordinate too far outside its diamond");
  return p;
}

Names names(const Node& node) {
  const int n = nodes_per_side(node.level);
  Names result{{node, {}, {}, {}}, 1};
  const auto add = [&](int d, int i, int j) {
    const Node other{wrap_diamond(d), node.level, i, j};
    const auto end = result.node.begin() + result.count;
    if (std::find(result.node.begin(), end, other) == end)
      result.node[static_cast<std::size_t>(result.count++)] = other;
  };
  const auto [d, level, i, j] = node;
  if ((i == 0 && j == 0) || (i == n && j == n)) {
    for (int k = 1; k < kDiamonds; ++k) add(d + k, i, j);
    return result;
  }
  if (j == 0) add(d - 1, 0, i);
  if (i == 0) add(d + 1, j, 0);
  if (j == n) add(d + 1, n, i);
  if (i == n) add(d - 1, j, n);
  return result;
}

std::array<ivec2, 2> halved_edge(int i, int j) {
  assert(((i | j) & 1) != 0);
  if ((j & 1) == 0) return {ivec2{i - 1, j}, ivec2{i + 1, j}};
  if ((i & 1) == 0) return {ivec2{i, j - 1}, ivec2{i, j + 1}};
  return {ivec2{i + 1, j - 1}, ivec2{i - 1, j + 1}};
}

Place locate(const dvec3& u, int level) {
  const int d = u.x > 0.0 && u.y >= 0.0   ? 0
                : u.x <= 0.0 && u.y > 0.0 ? 1
                : u.x < 0.0 && u.y <= 0.0 ? 2
                : u.y < 0.0               ? 3
                                          : 0;
  const int n = nodes_per_side(level);
  std::array<Corner, 3> t = root_corners(d, u.z >= 0.0, n);
  for (int k = 0; k < level; ++k) {
    const auto halve = [](const Corner& a, const Corner& b) {
      return Corner{(a.ij + b.ij) / 2, htm::midpoint(a.u, b.u)};
    };
    const std::array<Corner, 3> mid{halve(t[1], t[2]), halve(t[2], t[0]), halve(t[0], t[1])};
    // Walks by the nearest sign alone: a tie or rounding error puts the point into a neighbour, where the
    // affine coordinates below are still right to the same rounding. Exact ownership is htm::trixel's
    // business.
    if (determinant(mid[2].u, mid[1].u, u) >= 0.0) {
      t = {t[0], mid[2], mid[1]};
    } else if (determinant(mid[0].u, mid[2].u, u) >= 0.0) {
      t = {mid[2], t[1], mid[0]};
    } else if (determinant(mid[1].u, mid[0].u, u) >= 0.0) {
      t = {mid[1], mid[0], t[2]};
    } else {
      t = {mid[0], mid[1], mid[2]};
    }
  }
  const double w0 = determinant(t[1].u, t[2].u, u);
  const double w1 = determinant(t[2].u, t[0].u, u);
  const double w2 = determinant(t[0].u, t[1].u, u);
  const double sum = w0 + w1 + w2;
  const dvec2 ij = (w0 * dvec2(t[0].ij) + w1 * dvec2(t[1].ij) + w2 * dvec2(t[2].ij)) / sum;
  return {d, level, glm::dvec2{std::clamp(ij.x, 0.0, double(n)), std::clamp(ij.y, 0.0, double(n))}};
}

}  // namespace globe::planet
