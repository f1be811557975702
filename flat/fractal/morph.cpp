#include "flat/fractal/morph.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <numbers>

namespace globe::flat::fractal {
namespace {

namespace shader {
using namespace glm;
#include "shaders/flat/fractal_morph.glsl"
}  // namespace shader

constexpr double kBandShare = 0.6;  ///< of its end, where a band begins at the earliest
constexpr float kNowhere = 1e9f;

}  // namespace

MorphBands morph_bands(const Rings& rings, double slack, bool morph) {
  // A ring's radius counts from the middle of the square to middles of blocks; the viewer may be `off` from
  // the one, vertices half a diagonal from the other.
  const double off = std::numbers::sqrt2 * (0.5 + 0.5 * slack) + 0.5 * std::numbers::sqrt2;
  const std::array radii{rings.fine, rings.medium};
  MorphBands bands;
  double before = 0.0;  // where the finer level's blocks end
  for (std::size_t level = 0; level < radii.size(); ++level) {
    const double end = radii[level] - off, begin = std::max(kBandShare * end, before);
    const bool fits = morph && end > 0.0 && begin < end;
    bands.begin[level] = fits ? static_cast<float>(begin) : kNowhere;
    bands.end[level] = fits ? static_cast<float>(end) : 2.0f * kNowhere;
    before = radii[level] + off;
  }
  return bands;
}

float morph_share(const MorphBands& bands, int level, float away) {
  const auto k = static_cast<std::size_t>(level);
  return shader::share_of_band(away, bands.begin[k], bands.end[k]);
}

int last_level(int column, int row) {
  const int either = column | row;
  return (either & 1) != 0 ? 0 : (either & 2) != 0 ? 1 : 2;
}

Ends ends_of(int column, int row) {
  const int level = last_level(column, row), step = 1 << level;
  assert(level < kLevels - 1);
  const int i = column >> level, j = row >> level;
  if (i % 2 == 0) return {0, step};
  if (j % 2 == 0) return {step, 0};
  // The middle of a coarse cell lies on its diagonal, which take turns (block_triangles).
  return {step, (i / 2 + j / 2) % 2 == 0 ? step : -step};
}

}  // namespace globe::flat::fractal
