#include "globe/planet/lattice_trixel.h"

#include "globe/htm/midpoint.h"

namespace globe::planet {

std::array<htm::Corners, 4> children_corners(const htm::Corners& c) {
  const dvec3 m0 = htm::midpoint(c[1], c[2]);
  const dvec3 m1 = htm::midpoint(c[2], c[0]);
  const dvec3 m2 = htm::midpoint(c[0], c[1]);
  return {{{c[0], m2, m1}, {m2, c[1], m0}, {m1, m0, c[2]}, {m0, m1, m2}}};
}

htm::Corners corners(const LatticeTrixel& t) {
  return {node_direction({t.d, t.level, t.i, t.j}), node_direction({t.d, t.level, t.i + t.sign, t.j}),
          node_direction({t.d, t.level, t.i, t.j + t.sign})};
}

}  // namespace globe::planet
