#include "globe/htm/trixel.h"

#include <bit>
#include <cassert>
#include <cmath>

#include "globe/htm/descent.h"
#include "globe/htm/midpoint.h"
#include "globe/htm/predicates.h"
#include "globe/htm/start_table.h"

namespace globe::htm {
namespace {

constexpr std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }
constexpr std::size_t previous(std::size_t k) { return k == 0 ? 2 : k - 1; }

/// Octahedron vertices v0..v5 = +z, +x, +y, -x, -y, -z.
constexpr std::array<std::array<int, 3>, 6> kVertices{
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

/// Corners of S0..S3, N0..N3 as vertex numbers.
constexpr std::array<std::array<std::size_t, 3>, kRoots> kRootVertices{
    {{1, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}, {1, 0, 4}, {4, 0, 3}, {3, 0, 2}, {2, 0, 1}}};

/// What lies across an edge: the trixel there and the number that the edge has in it.
struct Across {
  Trixel trixel;
  std::size_t edge;
};

/// The root that has the same edge the other way round. Edge k runs from corner k + 1 to corner k + 2.
constexpr Across across_root_edge(std::size_t root, std::size_t edge) {
  const auto& own = kRootVertices[root];
  for (std::size_t other = 0; other < kRoots; ++other) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& theirs = kRootVertices[other];
      if (theirs[next(k)] == own[previous(edge)] && theirs[previous(k)] == own[next(edge)])
        return {Trixel{kFirstRoot + other}, k};
    }
  }
  return {};
}

constexpr auto kAcrossRootEdges = [] {
  std::array<std::array<Across, 3>, kRoots> table{};
  for (std::size_t root = 0; root < kRoots; ++root)
    for (std::size_t edge = 0; edge < 3; ++edge) table[root][edge] = across_root_edge(root, edge);
  return table;
}();

Trixel child_of(Trixel t, std::size_t k) { return {t.id << 2 | k}; }

std::size_t digit(Trixel t, int levels_below) { return t.id >> (2 * levels_below) & 3; }

std::size_t root_index(Trixel t, int depth) { return t.id >> (2 * depth) & 7; }

/// What lies across one edge: at once inside the parent, else a half of what lies across an edge of the
/// parent. Every level up is half as likely as the one before.
Across across_edge(Trixel t, int depth, std::size_t edge) {
  if (depth == 0) return kAcrossRootEdges[root_index(t, 0)][edge];
  const Trixel above{t.id >> 2};
  const std::size_t k = digit(t, 0);
  if (k == 3) return {child_of(above, edge), 0};
  if (edge == 0) return {child_of(above, 3), k};
  // Edges 1 and 2 of child k are halves of edges k + 1 and k + 2 of its parent. The two trixels beside an
  // edge run along it in opposite directions, which tells the corner that the halves share.
  const Across beyond = across_edge(above, depth - 1, edge == 1 ? next(k) : previous(k));
  if (edge == 1) return {child_of(beyond.trixel, next(beyond.edge)), 2};
  return {child_of(beyond.trixel, previous(beyond.edge)), 1};
}

Corners root_corners(std::size_t root) {
  const auto vertex = [&](std::size_t k) {
    const auto& v = kVertices[kRootVertices[root][k]];
    return dvec3{v[0], v[1], v[2]};
  };
  return {vertex(0), vertex(1), vertex(2)};
}

}  // namespace

std::optional<Trixel> trixel_from_id(std::uint64_t id) {
  const int bits = 64 - std::countl_zero(id);
  if (bits < 4 || bits % 2 != 0 || bits > 4 + 2 * kMaxLevel) return std::nullopt;
  return Trixel{id};
}

std::optional<Trixel> trixel_from_name(std::string_view text) {
  if (text.size() < 2 || text.size() > 2 + std::size_t{kMaxLevel}) return std::nullopt;
  const char hemisphere = text[0];
  if (hemisphere != 'N' && hemisphere != 'n' && hemisphere != 'S' && hemisphere != 's') return std::nullopt;
  std::uint64_t id = hemisphere == 'N' || hemisphere == 'n' ? 3 : 2;
  for (const char c : text.substr(1)) {
    if (c < '0' || c > '3') return std::nullopt;
    id = id << 2 | static_cast<std::uint64_t>(c - '0');
  }
  return Trixel{id};
}

std::string name(Trixel t) {
  const int depth = level(t);
  const std::size_t root = root_index(t, depth);
  std::string text{root < 4 ? 'S' : 'N'};
  for (int below = depth; below >= 0; --below) text += static_cast<char>('0' + digit(t, below));
  return text;
}

int level(Trixel t) { return (60 - std::countl_zero(t.id)) / 2; }

Trixel parent(Trixel t) {
  assert(level(t) > 0);
  return {t.id >> 2};
}

Trixel child(Trixel t, int k) {
  assert(k >= 0 && k <= 3 && level(t) < kMaxLevel);
  return child_of(t, static_cast<std::size_t>(k));
}

std::array<Trixel, 3> neighbors(Trixel t) {
  const int depth = level(t);
  return {across_edge(t, depth, 0).trixel, across_edge(t, depth, 1).trixel, across_edge(t, depth, 2).trixel};
}

Corners child_corners(const Corners& c, int k) {
  if (k == 3) return {midpoint(c[1], c[2]), midpoint(c[2], c[0]), midpoint(c[0], c[1])};
  const auto own = static_cast<std::size_t>(k);
  return {c[own], midpoint(c[own], c[next(own)]), midpoint(c[previous(own)], c[own])};
}

std::array<Corners, 4> children_corners(const Corners& c) {
  const dvec3 m01 = midpoint(c[0], c[1]);
  const dvec3 m12 = midpoint(c[1], c[2]);
  const dvec3 m20 = midpoint(c[2], c[0]);
  return {Corners{c[0], m01, m20}, Corners{c[1], m12, m01}, Corners{c[2], m20, m12}, Corners{m12, m20, m01}};
}

Corners corners(Trixel t) {
  const int depth = level(t);
  Corners c = root_corners(root_index(t, depth));
  for (int below = depth - 1; below >= 0; --below) c = child_corners(c, static_cast<int>(digit(t, below)));
  return c;
}

dvec3 center(Trixel t) {
  const Corners c = corners(t);
  const dvec3 sum = c[0] + c[1] + c[2];
  return sum * (1.0 / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z));
}

Trixel root_at(const dvec3& u) {
  const std::uint64_t octant = u.x > 0.0 && u.y >= 0.0   ? 0
                               : u.x <= 0.0 && u.y > 0.0 ? 1
                               : u.x < 0.0 && u.y <= 0.0 ? 2
                               : u.y < 0.0               ? 3
                                                         : 0;
  return {u.z >= 0.0 ? kFirstRoot + 7 - octant : kFirstRoot + octant};
}

Trixel trixel_by_walk(const dvec3& u, int level, std::uint64_t* exact_calls) {
  assert(level >= 0 && level <= kMaxLevel);
  assert(std::isfinite(u.x) && std::isfinite(u.y) && std::isfinite(u.z));
  std::uint64_t exact = 0;
  const auto inside = [&](const dvec3& a, const dvec3& b) {
    const Orientation side = orientation(a, b, u);
    exact += side.exact ? 1 : 0;
    return side.sign >= 0;
  };
  Trixel t = root_at(u);
  Corners c = root_corners(root_index(t, 0));
  for (int k = 0; k < level; ++k) {
    const dvec3 m01 = midpoint(c[0], c[1]);
    const dvec3 m20 = midpoint(c[2], c[0]);
    if (inside(m01, m20)) {
      c = {c[0], m01, m20};
      t = child_of(t, 0);
      continue;
    }
    const dvec3 m12 = midpoint(c[1], c[2]);
    if (inside(m12, m01)) {
      c = {c[1], m12, m01};
      t = child_of(t, 1);
    } else if (inside(m20, m12)) {
      c = {c[2], m20, m12};
      t = child_of(t, 2);
    } else {
      c = {m12, m20, m01};
      t = child_of(t, 3);
    }
  }
  if (exact_calls != nullptr) *exact_calls += exact;
  return t;
}

Trixel trixel_at(const dvec3& u, int level, std::uint64_t* exact_calls) {
  assert(level >= 0 && level <= kMaxLevel);
  const Top top = top_of(u.x, u.y, u.z);
  if (is_of_usual_length(top.descent) == 0) return trixel_by_walk(u, level, exact_calls);
  const std::optional<Descent> start = StartTable::get().descent(top.descent);
  if (!start) return trixel_by_walk(u, level, exact_calls);
  const bool is_deep = level > kDeepestOfShort;
  const Goal goal = is_deep ? goal_at<kLong>(level) : goal_at<kShort>(level);
  const Found found = arrive(
      top.root,
      is_deep ? descend<StartTable::kLevel, kLong>(*start) : descend<StartTable::kLevel, kShort>(*start),
      goal);
  if (found.certain == 0) return trixel_by_walk(u, level, exact_calls);
  return {found.id >> (2 * (goal.level - level))};
}

}  // namespace globe::htm
