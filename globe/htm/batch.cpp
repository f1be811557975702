#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "globe/base/vector_width.h"
#include "globe/htm/midpoint.h"
#include "globe/htm/predicates.h"
#include "globe/htm/trixel.h"

namespace globe::htm {
namespace {

constexpr std::size_t kLanes = 8;

struct Lane3 {
  std::array<double, kLanes> x, y, z;

  dvec3 get(std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, const dvec3& v) {
    x[k] = v.x;
    y[k] = v.y;
    z[k] = v.z;
  }
};

/// Eight walks side by side.
struct Walks {
  Lane3 u, c0, c1, c2;
  std::array<std::uint64_t, kLanes> id;
  std::array<std::uint64_t, kLanes> doubtful;  ///< 1 when a sign could not be told
};

inline dvec3 select(bool first, const dvec3& a, const dvec3& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

/// `level` steps of trixel_at for each lane, with selections in place of branches so that it compiles to
/// vectors.
GLOBE_FOR_EVERY_VECTOR_WIDTH void walk(Walks& w, int level) {
  for (int step = 0; step < level; ++step) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const dvec3 u = w.u.get(k), c0 = w.c0.get(k), c1 = w.c1.get(k), c2 = w.c2.get(k);
      const dvec3 m01 = midpoint(c0, c1), m12 = midpoint(c1, c2), m20 = midpoint(c2, c0);
      const Determinant d0 = rounded_determinant(m01, m20, u);
      const Determinant d1 = rounded_determinant(m12, m01, u);
      const Determinant d2 = rounded_determinant(m20, m12, u);
      const bool in0 = d0.value > 0.0, in1 = d1.value > 0.0, in2 = d2.value > 0.0;
      w.doubtful[k] |= static_cast<std::uint64_t>(std::abs(d0.value) <= d0.error) |
                       static_cast<std::uint64_t>(std::abs(d1.value) <= d1.error) |
                       static_cast<std::uint64_t>(std::abs(d2.value) <= d2.error);
      w.id[k] = w.id[k] << 2 | (in0 ? 0U : in1 ? 1U : in2 ? 2U : 3U);
      w.c0.set(k, select(in0, c0, select(in1, c1, select(in2, c2, m12))));
      w.c1.set(k, select(in0, m01, select(in1, m12, m20)));
      w.c2.set(k, select(in0, m20, select(in1, m01, select(in2, m12, m01))));
    }
  }
}

}  // namespace

void trixels_at(std::span<const dvec3> directions, int level, std::span<Trixel> result,
                std::uint64_t* exact_calls) {
  assert(result.size() == directions.size() && level >= 0 && level <= kMaxLevel);
  std::size_t first = 0;
  for (; first + kLanes <= directions.size(); first += kLanes) {
    Walks w;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Trixel root = root_at(directions[first + k]);
      const Corners corners = htm::corners(root);
      w.u.set(k, directions[first + k]);
      w.c0.set(k, corners[0]);
      w.c1.set(k, corners[1]);
      w.c2.set(k, corners[2]);
      w.id[k] = root.id;
      w.doubtful[k] = 0;
    }
    walk(w, level);
    for (std::size_t k = 0; k < kLanes; ++k)
      result[first + k] =
          w.doubtful[k] == 0 ? Trixel{w.id[k]} : trixel_at(directions[first + k], level, exact_calls);
  }
  for (; first < directions.size(); ++first) result[first] = trixel_at(directions[first], level, exact_calls);
}

}  // namespace globe::htm
