#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "globe/htm/descent.h"

namespace globe::htm {

/// Where a single look-up starts: the 1024 trixels of level 5 of one root, and which of them a direction is
/// likely to be in. (In vectors it is no gain: fetching a start costs as much as the levels it saves.)
///
/// A weight is det(u, a, b), a and b the ends of the side opposite, hence one scalar product with a x b. The
/// corners' and this product's roundings move the direction by less than the five levels' that they replace
/// (htm/descent.h).
class StartTable {
 public:
  static constexpr int kLevel = 5;

  /// Made when it is first asked for, in a tenth of a millisecond.
  static const StartTable& get();

  /// The descent of a direction at kLevel, from its weights at the top, whose sum must be finite and not 0.
  /// Nothing where the direction lies within rounding of a side.
  std::optional<Descent> descent(const Descent& top) const {
    const double scale = kGrid / (top.w0 + top.w1 + top.w2);
    const auto row = static_cast<std::size_t>(top.w0 * scale);
    const auto column = static_cast<std::size_t>(top.w1 * scale);
    constexpr int kMoves = 4;
    const Place place = find({top.w0, top.w1, top.w2}, guess_[row * kRow + column], kMoves);
    if (!place.found) return std::nullopt;
    const Start& s = start_[place.at];
    return Descent{place.w[0], place.w[1], place.w[2], s.q[0], s.q[1], s.q[2], s.c[0], s.c[1], s.c[2]};
  }

 private:
  static constexpr std::size_t kTrixels = std::size_t{1} << (2 * kLevel);
  static constexpr std::size_t kGrid = 128;  ///< four a trixel: three guesses out of four are right
  static constexpr std::size_t kRow = kGrid + 1;

  /// A trixel, corners by label.
  struct alignas(128) Start {
    std::array<std::array<double, 3>, 3> normal;  ///< of the sides, in the order of the weights at the top
    std::array<double, 3> q;
    std::array<std::uint16_t, 3> c;
    std::array<std::uint16_t, 3> across;  ///< the trixels beyond the sides; itself where the root ends
  };

  using Weights = std::array<double, 3>;
  struct Place {
    bool found;
    std::size_t at;
    Weights w;
  };

  StartTable();

  /// From one trixel to the next across the side that the direction is farthest beyond, `moves` of them.
  Place find(const Weights& top, std::size_t at, int moves) const {
    for (; moves > 0; --moves) {
      const Start& s = start_[at];
      Weights w;
      for (std::size_t k = 0; k < 3; ++k)
        w[k] = s.normal[k][0] * top[0] + s.normal[k][1] * top[1] + s.normal[k][2] * top[2];
      if (w[0] >= 0.0 && w[1] >= 0.0 && w[2] >= 0.0) return {true, at, w};
      at = s.across[w[0] <= w[1] && w[0] <= w[2] ? 0 : w[1] <= w[2] ? 1 : 2];
    }
    return {false, at, {}};
  }

  std::vector<Start> start_;
  std::vector<std::uint16_t> guess_;  ///< by the weights 0 and 1 in parts of kGrid
};

}  // namespace globe::htm
