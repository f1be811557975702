#include "globe/clipmap/patch.h"

#include <cstddef>

namespace globe::clipmap {
namespace {

int vertex_index(int m, int a, int b) { return b * (m + 1) - b * (b - 1) / 2 + a; }

/// The vertex that stands in for (a, b) when the edges in `rim` keep their even vertices only.
ivec2 stand_in(int m, int a, int b, int rim) {
  if ((rim & 4) != 0 && b == 0 && (a & 1) != 0) return {a - 1, 0};
  if ((rim & 2) != 0 && a == 0 && (b & 1) != 0) return {0, b - 1};
  if ((rim & 1) != 0 && a + b == m && (a & 1) != 0) return {a - 1, b + 1};
  return {a, b};
}

}  // namespace

PatchMesh make_patch_mesh(int m) {
  PatchMesh mesh;
  for (int b = 0; b <= m; ++b) {
    for (int a = 0; a + b <= m; ++a)
      mesh.vertices.push_back({static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)});
  }
  for (int rim = 0; rim < 8; ++rim) {
    const auto add = [&](ivec2 p, ivec2 q, ivec2 r) {
      const std::array<ivec2, 3> corner{stand_in(m, p.x, p.y, rim), stand_in(m, q.x, q.y, rim),
                                        stand_in(m, r.x, r.y, rim)};
      if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) return;
      for (const ivec2& v : corner) {
        mesh.indices[static_cast<std::size_t>(rim)].push_back(
            static_cast<std::uint16_t>(vertex_index(m, v.x, v.y)));
      }
    };
    for (int b = 0; b < m; ++b) {
      for (int a = 0; a + b < m; ++a) {
        add({a, b}, {a + 1, b}, {a, b + 1});
        if (a + b + 1 < m) add({a + 1, b + 1}, {a, b + 1}, {a + 1, b});
      }
    }
  }
  return mesh;
}

ivec2 patch_node(const LatticeTrixel& trixel, int m, int a, int b) {
  if (trixel.half == 0) return {trixel.i * m + a, trixel.j * m + b};
  return {(trixel.i + 1) * m - a, (trixel.j + 1) * m - b};
}

}  // namespace globe::clipmap
