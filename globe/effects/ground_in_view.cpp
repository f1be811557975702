#include "globe/effects/ground_in_view.h"

#include <algorithm>
#include <cmath>

namespace globe::effects {
namespace {

constexpr double kBuiltinHeight_m = 12e3;  ///< no ground of the built-in planet is farther from 0
constexpr double kCells = 32.0;            ///< that a distance is long, of those whose heights are taken
constexpr int kFinest = 24;

}  // namespace

double ground_height(const render::EffectView& view, const glm::dvec3& u, double distance_m) {
  const planet::Surface& surface = view.surface;
  const int level =
      std::clamp(static_cast<int>(std::log2(kCells * surface.root_edge() / distance_m)), 0, kFinest);
  return view.serving == render::Serving::kItsSet ? surface.height(u, level)
                                                  : surface.height_at_hand(u, level);
}

glm::dvec2 drawn_heights(const planet::Surface& surface) {
  double low = -kBuiltinHeight_m, high = kBuiltinHeight_m;
  if (const planet::Dataset* dataset = surface.dataset()) {
    low = high = 0.0;
    if (const planet::LayerInfo* layer = dataset->layer("height")) {
      low = layer->min;
      high = layer->max;
    }
    for (const planet::InsetInfo& inset : surface.info().insets) {
      if (inset.layer != "height") continue;
      low = std::min(low, inset.min);
      high = std::max(high, inset.max);
    }
    const double more = 0.1 * (high - low) + 100.0;
    low -= more;
    high += more;
  }
  const double top = surface.drawn_height(high) + (surface.has_bare_floor() ? planet::kHighestWave : 0.0);
  return {surface.mesh_height(low), std::max(top, surface.mesh_height(low) + 1.0)};
}

}  // namespace globe::effects
