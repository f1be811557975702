#include "globe/planet/subdivision.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>

namespace globe::planet {
namespace {

bool on_corner(int i, int j, int n) { return (i == 0 || i == n) && (j == 0 || j == n); }

/// Where a true node is seen in the plane of diamond d when the lattice is turned about the north pole, the
/// shorter way.
Node turned_north(const Node& node, int d) {
  // Into diamond d from d + 1 (i, j) = (-j', i' + j'); from d - 1 (i, j) = (i' + j', -i').
  const int turns = ((node.d - d) % 4 + 4) % 4;
  Node p = node;
  if (turns == 1) p = {d, node.level, -node.j, node.i + node.j};
  if (turns == 3) p = {d, node.level, node.i + node.j, -node.i};
  if (turns == 2) p = {d, node.level, -(node.i + node.j), node.i};
  p.d = d;
  return p;
}

/// The same about the south pole.
Node turned_south(const Node& node, int d) {
  const int n = nodes_per_side(node.level);
  const int a = n - node.i;
  const int b = n - node.j;
  const int turns = ((node.d - d) % 4 + 4) % 4;
  int pa = a;
  int pb = b;
  if (turns == 1) {
    pa = a + b;
    pb = -a;
  } else if (turns == 3) {
    pa = -b;
    pb = a + b;
  } else if (turns == 2) {
    pa = b;
    pb = -(a + b);
  }
  return {d, node.level, n - pa, n - pb};
}

/// Value of a true node from whichever of its images the tile holds.
template <typename T>
std::optional<T> find_value(const TileValues<T>& values, const Node& true_node) {
  const Names all = names(true_node);
  for (int k = 0; k < all.count; ++k) {
    const Node& name = all.node[static_cast<std::size_t>(k)];
    const int turns = ((name.d - values.id.d) % 4 + 4) % 4;
    for (const Node& image : {turned_north(name, values.id.d), turned_south(name, values.id.d)}) {
      if (values.holds(image.i, image.j)) return values.at(image.i, image.j);
    }
    if (turns == 2) {  // the other way round either pole
      const int n = nodes_per_side(name.level);
      const ivec2 north{name.j, -(name.i + name.j)};
      const int a = n - name.i;
      const int b = n - name.j;
      const ivec2 south{n + (a + b), n - a};
      if (values.holds(north.x, north.y)) return values.at(north.x, north.y);
      if (values.holds(south.x, south.y)) return values.at(south.x, south.y);
    }
  }
  return std::nullopt;
}

/// Value of a node born at `node.level` by its own diamond's stencil, from whatever images of the coarser
/// nodes are held.
template <typename T, typename Find>
std::optional<T> value_of_true_node(const Find& find, const Node& node) {
  const auto get = [&](ivec2 p) -> std::optional<T> {
    return find(fold({node.d, node.level - 1, p.x, p.y}));
  };
  if (((node.i | node.j) & 1) == 0) return get({node.i / 2, node.j / 2});
  const Butterfly s = butterfly(node.i, node.j);
  const Node a = fold({node.d, node.level - 1, s.a.x, s.a.y});
  const Node b = fold({node.d, node.level - 1, s.b.x, s.b.y});
  for (const auto& [corner, other] : {std::pair{a, b}, std::pair{b, a}}) {
    if (!is_corner(corner)) continue;
    const std::optional<T> v = find(corner);
    const std::optional<T> s0 = find(other);
    if (is_corner(other)) return v && s0 ? std::optional<T>((*v + *s0) * T(0.5)) : std::nullopt;
    const std::optional<T> s2 = find(opposite_neighbour(corner, other));
    return v && s0 && s2 ? std::optional<T>(corner_value(*v, *s0, *s2)) : std::nullopt;
  }
  const std::array<std::optional<T>, 8> v{get(s.a),       get(s.b),       get(s.c),       get(s.d),
                                          get(s.wing_ca), get(s.wing_cb), get(s.wing_da), get(s.wing_db)};
  if (!std::all_of(v.begin(), v.end(), [](const auto& x) { return x.has_value(); })) return std::nullopt;
  return butterfly_value(*v[0], *v[1], *v[2], *v[3], *v[4], *v[5], *v[6], *v[7]);
}

template <typename T>
void predict_plane(const TileValues<T>& parent, TileValues<T>& child) {
  const int side = child.id.stride();
  const auto coarse_stride = static_cast<std::ptrdiff_t>(parent.id.stride());
  // Child array index k is plane coordinate first - guard + k; the guard is even, so parity of k is parity of
  // the node.
  const int off_x = child.id.first_i() / 2 - parent.id.first_i() + kTileGuard / 2;
  const int off_y = child.id.first_j() / 2 - parent.id.first_j() + kTileGuard / 2;
  const auto at = [&](int x, int y) { return static_cast<std::ptrdiff_t>(y) * coarse_stride + x; };
  const T* coarse = parent.values.data();
  T* fine = child.values.data();
  for (int type = 0; type < 4; ++type) {
    const int di = type & 1;
    const int dj = type >> 1;
    if (type == 0) {
      for (int y = 0; y < side; y += 2) {
        const T* row = coarse + at(off_x, off_y + y / 2);
        T* out = fine + static_cast<std::ptrdiff_t>(y) * side;
        for (int x = 0; x < side; x += 2) out[x] = row[x / 2];
      }
      continue;
    }
    const Butterfly s = butterfly(di, dj);
    const std::ptrdiff_t a = at(s.a.x, s.a.y), b = at(s.b.x, s.b.y), c = at(s.c.x, s.c.y),
                         d = at(s.d.x, s.d.y);
    const std::ptrdiff_t ca = at(s.wing_ca.x, s.wing_ca.y), cb = at(s.wing_cb.x, s.wing_cb.y);
    const std::ptrdiff_t da = at(s.wing_da.x, s.wing_da.y), db = at(s.wing_db.x, s.wing_db.y);
    for (int y = dj; y < side; y += 2) {
      const T* row = coarse + at(off_x, off_y + y / 2);
      T* out = fine + static_cast<std::ptrdiff_t>(y) * side + di;
      const int count = (side - di + 1) / 2;
      for (int x = 0; x < count; ++x) {
        const T* p = row + x;
        out[2 * x] = butterfly_value(p[a], p[b], p[c], p[d], p[ca], p[cb], p[da], p[db]);
      }
    }
  }
}

/// Octahedron corner inside the tile's guarded square, if any (tiles this small hold at most one from 128
/// cells a side).
std::vector<ivec2> corners_near(const TileId& id) {
  const int n = nodes_per_side(id.level);
  std::vector<ivec2> found;
  for (const ivec2 corner : {ivec2{0, 0}, ivec2{n, 0}, ivec2{0, n}, ivec2{n, n}}) {
    const int x = corner.x - id.first_i() + kTileGuard;
    const int y = corner.y - id.first_j() + kTileGuard;
    if (x >= 0 && y >= 0 && x < id.stride() && y < id.stride()) found.push_back(corner);
  }
  return found;
}

template <typename T>
void predict_any(const TileValues<T>& parent, TileValues<T>& child) {
  assert(parent.id == child.id.parent());
  predict_plane(parent, child);
  // Around an octahedron corner the plane shows some nodes twice and joins what does not meet: take every
  // node there from its own diamond's stencil.
  const int n = nodes_per_side(child.id.level);
  constexpr int kReach = 3 * kTileGuard;
  for (const ivec2 corner : corners_near(child.id)) {
    for (int j = corner.y - kReach; j <= corner.y + kReach; ++j) {
      for (int i = corner.x - kReach; i <= corner.x + kReach; ++i) {
        if (!child.holds(i, j)) continue;
        const bool inside = i >= 0 && j >= 0 && i <= n && j <= n;
        if (inside && hex_length(i - corner.x, j - corner.y) > 1) continue;
        const auto find = [&](const Node& node) { return find_value(parent, node); };
        const auto value = value_of_true_node<T>(find, fold({child.id.d, child.id.level, i, j}));
        if (value) child.at(i, j) = *value;
      }
    }
  }
}

template <typename T>
void predict_whole_any(const Whole<T>& parents, Whole<T>& children) {
  const auto find = [&](const Node& node) -> std::optional<T> {
    return parents[static_cast<std::size_t>(node.d)].at(node.i, node.j);
  };
  for (int d = 0; d < kDiamonds; ++d) {
    TileValues<T>& child = children[static_cast<std::size_t>(d)];
    const int n = nodes_per_side(child.id.level);
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i)
        child.at(i, j) = *value_of_true_node<T>(find, names({d, child.id.level, i, j}).node[0]);
    }
  }
}

template <typename T>
void fill_guard_any(Whole<T>& whole) {
  for (int d = 0; d < kDiamonds; ++d) {
    TileValues<T>& tile = whole[static_cast<std::size_t>(d)];
    const int n = nodes_per_side(tile.id.level);
    for (int j = -kTileGuard; j <= n + kTileGuard; ++j) {
      for (int i = -kTileGuard; i <= n + kTileGuard; ++i) {
        if (i >= 0 && j >= 0 && i <= n && j <= n) continue;
        const Node node = fold({d, tile.id.level, i, j});
        tile.at(i, j) = whole[static_cast<std::size_t>(node.d)].at(node.i, node.j);
      }
    }
  }
}

}  // namespace

TileId tile_of(const Node& node) {
  const int n = nodes_per_side(node.level);
  const TileId whole{node.d, node.level, 0, 0};
  if (n <= kTileCells) return whole;
  const int last = n / kTileCells - 1;
  return {node.d, node.level, std::min(node.i / kTileCells, last), std::min(node.j / kTileCells, last)};
}

Butterfly butterfly(int i, int j) {
  assert(((i | j) & 1) != 0);
  const int x = (i - (i & 1)) / 2;
  const int y = (j - (j & 1)) / 2;
  if ((j & 1) == 0) {
    return {{x, y},         {x + 1, y},     {x, y + 1}, {x + 1, y - 1},
            {x - 1, y + 1}, {x + 1, y + 1}, {x, y - 1}, {x + 2, y - 1}};
  }
  if ((i & 1) == 0) {
    return {{x, y},         {x, y + 1},     {x + 1, y}, {x - 1, y + 1},
            {x + 1, y - 1}, {x + 1, y + 1}, {x - 1, y}, {x - 1, y + 2}};
  }
  return {{x + 1, y},     {x, y + 1},     {x, y},     {x + 1, y + 1},
          {x + 1, y - 1}, {x - 1, y + 1}, {x + 2, y}, {x, y + 2}};
}

bool is_corner(const Node& node) { return on_corner(node.i, node.j, nodes_per_side(node.level)); }

Node opposite_neighbour(const Node& corner, const Node& s0) {
  // In octahedral integers the four neighbours of corner ±n·axis are (±(n-1)·axis) ± one of the two other
  // axes; the opposite one has that other coordinate negated.
  const ivec3 c = octahedral_key(corner);
  const ivec3 s = octahedral_key(s0);
  const ivec3 wanted{c.x != 0 ? s.x : -s.x, c.y != 0 ? s.y : -s.y, c.z != 0 ? s.z : -s.z};
  const int n = nodes_per_side(corner.level);
  for (int d = 0; d < kDiamonds; ++d) {
    for (const ivec2 at : {ivec2{0, 0}, ivec2{n, 0}, ivec2{0, n}, ivec2{n, n}}) {
      for (const ivec2 step :
           {ivec2{1, 0}, ivec2{-1, 0}, ivec2{0, 1}, ivec2{0, -1}, ivec2{1, -1}, ivec2{-1, 1}}) {
        const Node candidate{d, corner.level, at.x + step.x, at.y + step.y};
        if (candidate.i < 0 || candidate.j < 0 || candidate.i > n || candidate.j > n) continue;
        if (octahedral_key(candidate) == wanted) return candidate;
      }
    }
  }
  assert(false && "opposite_neighbour: s0 is not a neighbour of the corner");
  return s0;
}

void predict(const TileValues<double>& parent, TileValues<double>& child) { predict_any(parent, child); }
void predict(const TileValues<float>& parent, TileValues<float>& child) { predict_any(parent, child); }
void predict(const Whole<double>& parents, Whole<double>& children) { predict_whole_any(parents, children); }
void predict(const Whole<float>& parents, Whole<float>& children) { predict_whole_any(parents, children); }
void fill_guard(Whole<double>& whole) { fill_guard_any(whole); }
void fill_guard(Whole<float>& whole) { fill_guard_any(whole); }

}  // namespace globe::planet
