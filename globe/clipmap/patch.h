#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "globe/clipmap/region.h"

namespace globe::clipmap {

/// The drawing unit: a trixel of m cells, one set of vertices and eight index lists.
///
/// A vertex is (a, b), a, b >= 0, a + b <= m: cells from corner 0 toward corners 1 and 2. Edge 0 is a + b =
/// m, edge 1 is a = 0, edge 2 is b = 0. Index list v leaves out the odd vertices of the edges whose bits are
/// set in v: beside a coarser region that edge must have the coarser region's vertices only, so that no
/// T-vertex remains. Triangles wind counter-clockwise seen from outside the planet.
struct PatchMesh {
  std::vector<std::array<std::uint8_t, 2>> vertices;
  std::array<std::vector<std::uint16_t>, 8> indices;
};

PatchMesh make_patch_mesh(int m);

/// Node of the level that a patch vertex stands on, plane coordinates of the patch's diamond.
ivec2 patch_node(const LatticeTrixel& trixel, int m, int a, int b);

}  // namespace globe::clipmap
