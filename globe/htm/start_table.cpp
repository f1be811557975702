#include "globe/htm/start_table.h"

#include <glm/geometric.hpp>

#include "globe/htm/trixel.h"

namespace globe::htm {
namespace {

/// The root whose corners 0, 1, 2 are +y, +z, +x: weights of all roots are mirrored into it.
constexpr std::uint64_t kRoot = 15;

dvec3 by_weights(const dvec3& u) { return {u.y, u.z, u.x}; }

}  // namespace

const StartTable& StartTable::get() {
  static const StartTable table;
  return table;
}

StartTable::StartTable() : start_(kTrixels), guess_(kRow * kRow) {
  for (std::size_t number = 0; number < kTrixels; ++number) {
    const Trixel t{kRoot << (2 * kLevel) | number};
    Start& start = start_[number];
    std::size_t label = 0;  // of corner 0
    for (int below = kLevel - 1; below >= 0; --below) {
      const std::size_t digit = t.id >> (2 * below) & 3;
      for (std::uint16_t& c : start.c) c = static_cast<std::uint16_t>(2 * c);
      if (digit == 3) continue;
      label = (label + digit) % 3;
      ++start.c[label];
    }
    const Corners corner = corners(t);
    const auto beyond = neighbors(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t own = (label + k) % 3;
      const dvec3 &a = corner[(k + 1) % 3], &b = corner[(k + 2) % 3];
      const dvec3 normal = by_weights(0.5 * glm::cross(a - b, a + b));  // a x b without cancellation
      start.normal[own] = {normal.x, normal.y, normal.z};
      start.q[own] = 0.25 * glm::dot(a - b, a - b);
      const bool same_root = beyond[k].id >> (2 * kLevel) == kRoot;
      start.across[own] = static_cast<std::uint16_t>(same_root ? beyond[k].id % kTrixels : number);
    }
  }
  constexpr int kFarthest = 200;  // moves across the whole root
  std::size_t at = 0;
  for (std::size_t row = 0; row < kGrid; ++row) {
    for (std::size_t column = 0; row + column < kGrid; ++column) {
      const double w0 = static_cast<double>(row) + 1.0 / 3, w1 = static_cast<double>(column) + 1.0 / 3;
      at = find({w0, w1, kGrid - w0 - w1}, at, kFarthest).at;
      guess_[row * kRow + column] = static_cast<std::uint16_t>(at);
    }
  }
}

}  // namespace globe::htm
