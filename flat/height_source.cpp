#include "flat/height_source.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace globe::flat {

double height_m(const HeightSource& source, double x_m, double y_m) {
  double x = x_m / source.spacing_m();
  double y = y_m / source.spacing_m();
  double last_i = std::floor(x) + 1.0;
  double last_j = std::floor(y) + 1.0;
  if (const auto extent = source.extent()) {
    const auto west = static_cast<double>(extent->i0);
    const auto south = static_cast<double>(extent->j0);
    x = std::clamp(x, west, west + extent->columns - 1);
    y = std::clamp(y, south, south + extent->rows - 1);
    last_i = west + extent->columns - 1;
    last_j = south + extent->rows - 1;
  }
  const double i = std::min(std::floor(x), last_i - 1.0);
  const double j = std::min(std::floor(y), last_j - 1.0);
  std::array<float, 4> corners{};
  source.posts({static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), 2, 2, 1}, corners);
  const double u = x - i;
  const double v = y - j;
  const std::array<double, 4> h{corners[0], corners[1], corners[2], corners[3]};
  return (h[0] * (1.0 - u) + h[1] * u) * (1.0 - v) + (h[2] * (1.0 - u) + h[3] * u) * v;
}

}  // namespace globe::flat
