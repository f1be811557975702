#include "globe/clipmap/morph.h"

#include <algorithm>
#include <cmath>

namespace globe::clipmap {
namespace {

/// Radius of the finest hexagon in heights above ground when it is admitted. At 1 a cell is 1/s of the
/// height: 10 pixels at s = 64 in a view 720 pixels high and 60 degrees wide.
constexpr double kReach = 1.0;

}  // namespace

double wanted_level(const Settings& settings, double root_edge, double height_m) {
  return std::log2(root_edge * settings.s / (kReach * height_m));
}

FinestLevel finest_level(const Settings& settings, double root_edge, double height_m, int max_level) {
  const double wanted = wanted_level(settings, root_edge, std::max(height_m, 1e-3));
  if (wanted < settings.base_level + 1) return {settings.base_level, 0.0f};
  if (wanted >= max_level + 1) return {max_level, 0.0f};
  const double whole = std::floor(wanted);
  if (!settings.morph) return {static_cast<int>(whole), 0.0f};
  const double t = std::clamp(1.0 - 2.0 * (wanted - whole), 0.0, 1.0);
  return {static_cast<int>(whole), static_cast<float>(t * t * (3.0 - 2.0 * t))};
}

}  // namespace globe::clipmap
