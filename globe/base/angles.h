#pragma once

#include <numbers>

namespace globe {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< radians in it
inline constexpr double kRadian = 180.0 / std::numbers::pi;  ///< degrees in it

}  // namespace globe
