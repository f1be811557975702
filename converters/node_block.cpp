#include "converters/node_block.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "globe/base/vector_width.h"

namespace converters {
namespace {

using globe::planet::dvec3;
using globe::planet::node_direction;

/// Directions of a row of nodes by coordinate, as vectors of numbers take them.
struct Row {
  std::vector<double> x, y, z;

  explicit Row(std::size_t count) : x(count), y(count), z(count) {}
  void put(std::size_t i, const dvec3& u) {
    x[i] = u.x;
    y[i] = u.y;
    z[i] = u.z;
  }
  dvec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// globe::htm::midpoint of each a and b, by the same operations.
GLOBE_FOR_EVERY_VECTOR_WIDTH
void midpoints(const double* ax, const double* ay, const double* az, const double* bx, const double* by,
               const double* bz, std::size_t count, double* __restrict x, double* __restrict y,
               double* __restrict z) {
  for (std::size_t k = 0; k < count; ++k) {
    const double sx = ax[k] + bx[k], sy = ay[k] + by[k], sz = az[k] + bz[k];
    const double scale = 1.0 / std::sqrt(sx * sx + sy * sy + sz * sz);
    x[k] = sx * scale;
    y[k] = sy * scale;
    z[k] = sz * scale;
  }
}

void halve(const Row& a, std::size_t first_a, const Row& b, std::size_t first_b, std::size_t count,
           Row& out) {
  midpoints(a.x.data() + first_a, a.y.data() + first_a, a.z.data() + first_a, b.x.data() + first_b,
            b.y.data() + first_b, b.z.data() + first_b, count, out.x.data(), out.y.data(), out.z.data());
}

}  // namespace

NodeBlock::NodeBlock(int d, int level, int i0, int j0, int side)
    : d_(d),
      level_(level),
      i0_(i0),
      j0_(j0),
      side_(side),
      directions_(static_cast<std::size_t>((side + 1) * (side + 1))) {
  assert((side & (side - 1)) == 0 && i0 % side == 0 && j0 % side == 0);
  const auto n = static_cast<std::size_t>(side);
  const auto slot = [&](std::size_t i, std::size_t j) -> dvec3& { return directions_[j * (n + 1) + i]; };
  for (const int j : {0, side}) {
    for (const int i : {0, side})
      slot(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) =
          node_direction({d, level, i0 + i, j0 + j});
  }
  // At each step the nodes that halve an edge of the lattice twice as coarse: along i, along j, and across.
  Row upper(n / 2 + 1), lower(n / 2 + 1), made(n / 2 + 1);
  for (std::size_t s = n; s >= 2; s /= 2) {
    const std::size_t h = s / 2, cells = n / s;
    const auto take = [&](std::size_t j, Row& row) {
      for (std::size_t k = 0; k <= cells; ++k) row.put(k, slot(k * s, j));
    };
    const auto put = [&](std::size_t first, std::size_t count, std::size_t j) {
      for (std::size_t k = 0; k < count; ++k) slot(first + k * s, j) = made.at(k);
    };
    take(0, lower);
    halve(lower, 0, lower, 1, cells, made);
    put(h, cells, 0);
    for (std::size_t j = s; j <= n; j += s) {
      std::swap(upper, lower);
      take(j, lower);
      halve(upper, 0, lower, 0, cells + 1, made);
      put(0, cells + 1, j - h);
      halve(upper, 1, lower, 0, cells, made);
      put(h, cells, j - h);
      halve(lower, 0, lower, 1, cells, made);
      put(h, cells, j);
    }
  }
}

}  // namespace converters
