#pragma once

#include <cmath>

namespace globe {

/// Linear light of an sRGB value in [0, 1] (IEC 61966-2-1).
inline float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace globe
