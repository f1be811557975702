#include "converters/interpolate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "converters/footprint_lines.h"
#include "converters/strips.h"

namespace converters {
namespace {

constexpr std::size_t kMaxStride = std::tuple_size_v<ChannelSums>;  ///< three channels and a weight
using Sum = ChannelSums;

/// Below this share of the whole weight nothing valid counts as in reach: it would be rounding noise.
constexpr double kLeastWeight = 1e-9;

bool weighted(const Window& window, int channels) { return window.stride > channels; }

/// Divides by the weight of what was valid; gives its share of `whole`.
double finish(const Window& window, int channels, const Sum& sum, double whole, float* out) {
  const double weight = weighted(window, channels) ? sum[static_cast<std::size_t>(channels)] : whole;
  if (!(weight > kLeastWeight * whole)) return 0.0;
  for (int c = 0; c < channels; ++c) out[c] = static_cast<float>(sum[static_cast<std::size_t>(c)] / weight);
  return weight == whole ? 1.0 : std::min(1.0, weight / whole);
}

void add(const float* sample, int stride, double weight, Sum& sum) {
  for (int c = 0; c < stride; ++c)
    sum[static_cast<std::size_t>(c)] += weight * static_cast<double>(sample[c]);
}

std::array<double, 4> catmull_rom(double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (-3.0 * t3 + 4.0 * t2 + t),
          0.5 * (t3 - t2)};
}

/// Leaves of strips what lies on the map or within a sample of it.
void keep_on_map(const MapGeometry& geometry, int origin, FootprintLines::Strips& strips) {
  if (geometry.period > 0 && geometry.is_whole_planet()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < strips.count; ++k) {
    Strip strip = strips.strip[k];
    if (geometry.period == 0) {
      strip.a = std::max(strip.a, -1.0 - origin);
      strip.b = std::min(strip.b, double(geometry.width) - origin);
    }
    if (strip.b > strip.a && strip.y > -1.0 && strip.y < geometry.height) strips.strip[kept++] = strip;
  }
  strips.count = kept;
}

}  // namespace

double nearest(const Window& window, int channels, const SamplePlace& place, float* out) {
  const float* sample = window.at(place.x.whole + (place.x.fraction >= 0.5 ? 1 : 0),
                                  place.y.whole + (place.y.fraction >= 0.5 ? 1 : 0));
  if (weighted(window, channels) && sample[channels] == 0.0F) return 0.0;
  std::copy_n(sample, channels, out);
  return 1.0;
}

double bilinear(const Window& window, int channels, const SamplePlace& place, float* out) {
  const double fx = place.x.fraction;
  const double fy = place.y.fraction;
  const float* top = window.at(place.x.whole, place.y.whole);
  const float* bottom = window.at(place.x.whole, place.y.whole + 1);
  Sum sum{};
  add(top, window.stride, (1.0 - fx) * (1.0 - fy), sum);
  add(top + window.stride, window.stride, fx * (1.0 - fy), sum);
  add(bottom, window.stride, (1.0 - fx) * fy, sum);
  add(bottom + window.stride, window.stride, fx * fy, sum);
  return finish(window, channels, sum, 1.0, out);
}

double bicubic(const Window& window, int channels, const SamplePlace& place, float* out) {
  const std::array<double, 4> wx = catmull_rom(place.x.fraction);
  const std::array<double, 4> wy = catmull_rom(place.y.fraction);
  const int stride = window.stride;
  Sum sum{};
  std::array<float, kMaxStride> low;
  std::array<float, kMaxStride> high;
  low.fill(HUGE_VALF);
  high.fill(-HUGE_VALF);
  for (int b = 0; b < 4; ++b) {
    const float* sample = window.at(place.x.whole - 1, place.y.whole - 1 + b);
    for (int a = 0; a < 4; ++a, sample += stride) {
      // Negative weights and missing samples do not go together.
      if (weighted(window, channels) && sample[channels] == 0.0F)
        return bilinear(window, channels, place, out);
      add(sample, stride, wx[static_cast<std::size_t>(a)] * wy[static_cast<std::size_t>(b)], sum);
      for (int c = 0; c < channels; ++c) {
        low[static_cast<std::size_t>(c)] = std::min(low[static_cast<std::size_t>(c)], sample[c]);
        high[static_cast<std::size_t>(c)] = std::max(high[static_cast<std::size_t>(c)], sample[c]);
      }
    }
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
    out[c] = std::clamp(static_cast<float>(sum[c]), low[c], high[c]);
  return 1.0;
}

double footprint_mean(const Window& window, int channels, const MapGeometry& geometry,
                      const Footprint& footprint, const SamplePlace& place, float* out) {
  Sum sum{};
  double whole = 0;
  for (FootprintLines lines(geometry, footprint); lines.more();) {
    FootprintLines::Strips strips = lines.next();
    for (std::size_t k = 0; k < strips.count; ++k)
      whole += strips.strip[k].weight * (strips.strip[k].b - strips.strip[k].a);
    keep_on_map(geometry, place.x.whole, strips);
    if (strips.count > 0) add_strips(window, place.x.whole, strips.strip.data(), strips.count, sum);
  }
  return whole > 0.0 ? finish(window, channels, sum, whole, out) : bilinear(window, channels, place, out);
}

double cap_mean(const SourceMap& map, double rim, bool north, float* out) {
  const MapGeometry& geometry = map.geometry();
  const EvenLines lines(north ? -0.5 : rim, north ? rim : geometry.height - 0.5);
  Sum sum{};
  double whole = 0;
  Window window;
  window.width = geometry.period + 1;  // the first column again, to close the circle
  window.height = 2;
  for (int line = 0; line < lines.count; ++line) {
    const double y = lines.y(line);
    window.y0 = static_cast<int>(std::floor(y));
    map.read(window);
    const Strip strip{y, 0.0, static_cast<double>(geometry.period), row_weight(geometry, y)};
    add_strips(window, 0, &strip, 1, sum);
    whole += strip.weight * geometry.period;
  }
  return whole > 0.0 ? finish(window, map.channels(), sum, whole, out)
                     : row_mean(map, north ? 0 : geometry.height - 1, out);
}

double row_mean(const SourceMap& map, int y, float* out) {
  Window window;
  window.y0 = y;
  window.width = map.geometry().period;
  window.height = 1;
  map.read(window);
  Sum sum{};
  for (int x = 0; x < window.width; ++x) add(window.at(x, y), window.stride, 1.0, sum);
  return finish(window, map.channels(), sum, window.width, out);
}

}  // namespace converters
