#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "globe/planet/grid.h"

namespace converters {

inline constexpr std::size_t kMaxChannels = 4;

/// Filtered value (pyramid.h) at a node on a diamond's border, the same from each diamond that has it: sums
/// in the order of the name with the smallest diamond, each neighbour taken once.
/// @param fine  the node at the finer level, both coordinates even
/// @param value_at  const float*(const Node&): the channels at the node or a neighbour, in some name of it
template <typename ValueAt>
void filter_border(const globe::planet::Node& fine, std::size_t channels, const ValueAt& value_at,
                   float* out) {
  using globe::planet::Node;
  const globe::planet::Names all = globe::planet::names(fine);
  const Node node =
      *std::min_element(all.node.begin(), all.node.begin() + all.count, [](const Node& a, const Node& b) {
        return std::array{a.d, a.i, a.j} < std::array{b.d, b.i, b.j};
      });
  std::array<globe::planet::ivec3, 6> seen{};
  std::array<double, kMaxChannels> sum{};
  std::size_t count = 0;
  for (const auto& step : globe::planet::kLatticeSteps) {
    const Node neighbor = globe::planet::fold({node.d, node.level, node.i + step.x, node.j + step.y});
    const globe::planet::ivec3 key = globe::planet::octahedral_key(neighbor);
    if (std::find(seen.begin(), seen.begin() + count, key) != seen.begin() + count) continue;
    seen[count++] = key;
    const float* value = value_at(neighbor);
    for (std::size_t c = 0; c < channels; ++c) sum[c] += static_cast<double>(value[c]);
  }
  const float* own = value_at(node);
  for (std::size_t c = 0; c < channels; ++c)
    out[c] =
        static_cast<float>((2.0 * static_cast<double>(own[c]) + sum[c]) / (2.0 + static_cast<double>(count)));
}

/// The same away from the border: `own` points at the node, `row` floats lie between rows.
inline void filter_inside(const float* own, std::ptrdiff_t channels, std::ptrdiff_t row, float* out) {
  for (std::ptrdiff_t c = 0; c < channels; ++c, ++own) {
    const float around =
        own[channels] + own[-channels] + own[row] + own[-row] + own[channels - row] + own[row - channels];
    out[c] = 0.25F * own[0] + 0.125F * around;
  }
}

}  // namespace converters
