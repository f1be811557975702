#pragma once

#include <array>
#include <cstddef>

#include "converters/source_map.h"

namespace converters {

/// Sums by channel; of a window with weights (source_map.h) theirs come last.
using ChannelSums = std::array<double, 4>;

/// A piece of a line of constant latitude that a mean is taken over.
struct Strip {
  double y;     ///< row coordinate, above -1
  double a, b;  ///< columns where it begins and ends, counted from an origin; a < b
  double weight;
};

/// Adds the integrals of a window's samples, joined bilinearly, over strips in ascending rows. The window
/// holds every sample in reach. The sums do not depend on where the window or the origin lies.
/// REQUIRES: count > 0.
void add_strips(const Window& window, int origin, const Strip* strips, std::size_t count, ChannelSums& sums);

}  // namespace converters
