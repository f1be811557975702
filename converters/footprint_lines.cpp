#include "converters/footprint_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "globe/base/bit_select.h"

namespace converters {
namespace {

using Sides = FootprintLines::Sides;
using Crossings = FootprintLines::Crossings;

GLOBE_INLINE void meet(const Sides& sides, std::size_t k, double y, double& a, double& b, double& count) {
  const std::uint64_t inside = globe::mask_of(y >= sides.top[k]) & globe::mask_of(y < sides.bottom[k]);
  const double x = sides.x[k] + sides.slope[k] * (y - sides.top[k]);
  a = globe::select(inside & globe::mask_of(x < a), x, a);
  b = globe::select(inside & globe::mask_of(x > b), x, b);
  count += globe::select(inside, 1.0, 0.0);
}

/// `a` begins at the right bound and `b` at the left one, so that rounding leads out of neither.
GLOBE_FOR_EVERY_VECTOR_WIDTH
void cross(const Sides& sides, Crossings& lines) {
  for (std::size_t line = 0; line < FootprintLines::kAtOnce; ++line) {
    const double y = lines.y[line];
    double a = sides.right, b = sides.left, count = 0.0;
    meet(sides, 0, y, a, b, count);
    meet(sides, 1, y, a, b, count);
    meet(sides, 2, y, a, b, count);
    meet(sides, 3, y, a, b, count);
    meet(sides, 4, y, a, b, count);
    meet(sides, 5, y, a, b, count);
    lines.a[line] = globe::select(globe::mask_of(a < sides.left), sides.left, a);
    lines.b[line] = globe::select(globe::mask_of(b > sides.right), sides.right, b);
    lines.count[line] = count;
  }
}

Sides sides_of(const Footprint& footprint) {
  Sides sides;
  const auto count = static_cast<std::size_t>(footprint.count);
  for (std::size_t k = 0; k < count; ++k) {
    const Footprint::Corner& p = footprint.corner[k];
    const Footprint::Corner& q = footprint.corner[k + 1 == count ? 0 : k + 1];
    const bool down = q.y >= p.y;
    sides.top[k] = down ? p.y : q.y;
    sides.bottom[k] = down ? q.y : p.y;
    sides.x[k] = down ? p.x : q.x;
    // A level side is crossed by no line: its slope is of no account.
    const double height = q.y - p.y;
    sides.slope[k] = (q.x - p.x) / (height == 0.0 ? 1.0 : height);
  }
  sides.left = footprint.min_x();
  sides.right = footprint.max_x();
  return sides;
}

}  // namespace

EvenLines::EvenLines(double top, double bottom) {
  constexpr int kLeast = 8;
  count = std::max(kLeast, static_cast<int>(std::ceil(bottom - top)));
  step = (bottom - top) / count;
  first = top + 0.5 * step;
}

FootprintLines::FootprintLines(const MapGeometry& geometry, const Footprint& footprint)
    : geometry_(geometry), lines_(footprint.min_y(), footprint.max_y()), sides_(sides_of(footprint)) {}

FootprintLines::Strips FootprintLines::next() {
  // Beyond a pole there is no more of the planet; beyond another end of the map there is.
  constexpr double kFar = std::numeric_limits<double>::max();
  const double north = geometry_.north_shift != MapGeometry::kNoPole ? -0.5 : -kFar;
  const double south = geometry_.south_shift != MapGeometry::kNoPole ? geometry_.height - 0.5 : kFar;
  Crossings lines;
  for (std::size_t line = 0; line < kAtOnce; ++line)
    lines.y[line] = std::min(std::max(lines_.y(begin_ + static_cast<int>(line)), north), south);
  cross(sides_, lines);
  std::array<double, kAtOnce> weight;
  row_weights(geometry_, lines.y.data(), kAtOnce, weight.data());
  Strips strips;
  for (std::size_t line = 0; line < kAtOnce && begin_ < lines_.count; ++line, ++begin_) {
    if (lines.count[line] > 2.0) {
      add_strips_of(lines.y[line], weight[line], strips);
    } else if (lines.b[line] > lines.a[line]) {
      strips.strip[strips.count++] = {lines.y[line], lines.a[line], lines.b[line], weight[line]};
    }
  }
  return strips;
}

/// Of a line that enters and leaves more than once.
void FootprintLines::add_strips_of(double y, double weight, Strips& strips) const {
  std::array<double, kSides> x;
  x.fill(std::numeric_limits<double>::max());
  std::size_t count = 0;
  for (std::size_t k = 0; k < kSides; ++k) {
    if (y >= sides_.top[k] && y < sides_.bottom[k])
      x[count++] = std::clamp(sides_.x[k] + sides_.slope[k] * (y - sides_.top[k]), sides_.left, sides_.right);
  }
  std::sort(x.begin(), x.end());
  for (std::size_t k = 0; k + 1 < count; k += 2)
    if (x[k + 1] > x[k]) strips.strip[strips.count++] = {y, x[k], x[k + 1], weight};
}

}  // namespace converters
