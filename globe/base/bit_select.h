#pragma once

#include <bit>
#include <cstdint>

#include "globe/base/vector_width.h"

// Choices without branches, for code that is to become vectors: a branch written as such stays one, and keeps
// the loop around it from being vectorised.
namespace globe {

/// All bits set, or none.
GLOBE_INLINE std::uint64_t mask_of(bool condition) { return condition ? ~std::uint64_t{0} : 0; }

/// a where the mask is set, b where it is not.
GLOBE_INLINE double select(std::uint64_t mask, double a, double b) {
  return std::bit_cast<double>((mask & std::bit_cast<std::uint64_t>(a)) |
                               (~mask & std::bit_cast<std::uint64_t>(b)));
}

}  // namespace globe
