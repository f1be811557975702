#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "globe/planet/subdivision.h"

namespace globe::planet {

/// Catmull and Rom's spline between p[1] (t = 0) and p[2] (t = 1), clamped to the range of the four.
inline double clamped_spline(const std::array<double, 4>& p, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double value = p[1] + 0.5 * ((p[2] - p[0]) * t + (2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3]) * t2 +
                                     (3.0 * (p[1] - p[2]) + p[3] - p[0]) * t3);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  return std::clamp(value, *low, *high);
}

/// The node that a plane coordinate within one of the diamond means. A line along the diamond's border goes
/// on straight through an octahedron corner, seen from whichever side, where `fold` would turn off.
inline Node continued(const Node& plane) {
  const int n = nodes_per_side(plane.level);
  const Node corner{plane.d, plane.level, std::clamp(plane.i, 0, n), std::clamp(plane.j, 0, n)};
  const bool one_outside = (corner.i != plane.i) != (corner.j != plane.j);
  if (!one_outside || !is_corner(corner)) return fold(plane);
  return opposite_neighbour(corner, {plane.d, plane.level, 2 * corner.i - plane.i, 2 * corner.j - plane.j});
}

/// Spline along i, then along j, over the 4 x 4 nodes around a cell; (x, y) in [0, 1]^2 is the place in it.
/// `value_at(node)` gives a node's value.
template <typename ValueAt>
double lattice_spline(const Node& cell, double x, double y, const ValueAt& value_at) {
  std::array<double, 4> rows{};
  for (int dj = -1; dj <= 2; ++dj) {
    std::array<double, 4> row{};
    for (int di = -1; di <= 2; ++di) {
      row[static_cast<std::size_t>(di + 1)] =
          value_at(continued({cell.d, cell.level, cell.i + di, cell.j + dj}));
    }
    rows[static_cast<std::size_t>(dj + 1)] = clamped_spline(row, x);
  }
  return clamped_spline(rows, y);
}

}  // namespace globe::planet
