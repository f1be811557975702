#include "converters/interpolate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace converters {
namespace {

constexpr std::size_t kMaxStride = 4;  ///< three channels and a weight
using Sum = std::array<double, kMaxStride>;

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

/// Weights of two rows of a window in a strip between them, and where it begins and ends: columns.
struct Strip {
  int row;
  double top, bottom;  ///< weights of the row and of the next one
  double a, b;
};

/// Adds the integral over a strip; rows are joined linearly. Stride floats a sample.
template <std::size_t Stride>
void integrate(const Window& window, const Strip& strip, Sum& sum) {
  const int first = static_cast<int>(std::floor(strip.a));
  const int last = static_cast<int>(std::floor(strip.b));
  const float* top = window.at(first, strip.row);
  const float* bottom = strip.bottom > 0.0 ? window.at(first, strip.row + 1) : top;
  const auto sample = [&](int column, double weight) {
    const std::size_t at = static_cast<std::size_t>(column) * Stride;
    for (std::size_t c = 0; c < Stride; ++c) {
      sum[c] += weight * (strip.top * static_cast<double>(top[at + c]) +
                          strip.bottom * static_cast<double>(bottom[at + c]));
    }
  };
  const double from = strip.a - first, to = strip.b - last;
  if (first == last) {
    const double middle = 0.5 * (from + to);
    sample(0, (to - from) * (1.0 - middle));
    sample(1, (to - from) * middle);
    return;
  }
  // Of the first column to the next, of the last to the one after it, and a whole column before each between.
  const int end = last - first;
  const double left = 1.0 - from, left_next = 0.5 * left * (1.0 + from);
  const double right_next = 0.5 * to * to, right = to - right_next;
  sample(0, left - left_next);
  if (end == 1) {
    sample(1, left_next + right);
  } else {
    sample(1, left_next + 0.5);
    for (int column = 2; column < end; ++column) sample(column, 1.0);
    sample(end, 0.5 + right);
  }
  if (to > 0.0) sample(end + 1, right_next);
}

/// The sides of a footprint, for scan lines to cross.
class Sides {
 public:
  explicit Sides(const Footprint& footprint) : count_(footprint.count) {
    for (int k = 0; k < count_; ++k) {
      Footprint::Corner a = footprint.corner[static_cast<std::size_t>(k)];
      Footprint::Corner b = footprint.corner[static_cast<std::size_t>((k + 1) % count_)];
      if (b.y < a.y) std::swap(a, b);
      side_[static_cast<std::size_t>(k)] = {a.y, b.y, a.x, b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0.0};
    }
  }

  /// The columns where a line enters and leaves, in order; at most six.
  int crossings(double y, std::array<double, 6>& out) const {
    int count = 0;
    for (int k = 0; k < count_; ++k) {
      const Side& side = side_[static_cast<std::size_t>(k)];
      if (y < side.top || y >= side.bottom) continue;
      const double x = side.x + side.slope * (y - side.top);
      int at = count++;
      for (; at > 0 && out[static_cast<std::size_t>(at - 1)] > x; --at)
        out[static_cast<std::size_t>(at)] = out[static_cast<std::size_t>(at - 1)];
      out[static_cast<std::size_t>(at)] = x;
    }
    return count;
  }

 private:
  struct Side {
    double top, bottom, x, slope;
  };
  std::array<Side, 6> side_;
  int count_;
};

/// Lines of constant latitude across a range of rows: symmetric about its middle, no farther apart than rows.
struct Lines {
  double first;
  double step;
  int count;

  Lines(double top, double bottom) {
    constexpr int kLeast = 8;
    count = std::max(kLeast, static_cast<int>(std::ceil(bottom - top)));
    step = (bottom - top) / count;
    first = top + 0.5 * step;
  }
  double y(int line) const { return first + line * step; }
};

/// Adds the strip along y between two columns, as much of it as lies on the map or within a sample of it.
template <std::size_t Stride>
void add_strip(const Window& window, const MapGeometry& geometry, double y, double a, double b, double weight,
               Sum& sum) {
  if (geometry.period == 0) {
    a = std::clamp(a, -1.0, double(geometry.width));
    b = std::clamp(b, -1.0, double(geometry.width));
  }
  const int row = static_cast<int>(std::floor(y));
  if (b <= a || !(has_row(geometry, row) || has_row(geometry, row + 1))) return;
  const double below = y - row;
  integrate<Stride>(window, {row, weight * (1.0 - below), weight * below, a, b}, sum);
}

/// Calls body with the window's stride as a constant.
template <typename Body>
auto with_stride(const Window& window, const Body& body) {
  switch (window.stride) {
    case 1:
      return body(std::integral_constant<std::size_t, 1>{});
    case 2:
      return body(std::integral_constant<std::size_t, 2>{});
    case 3:
      return body(std::integral_constant<std::size_t, 3>{});
    default:
      return body(std::integral_constant<std::size_t, kMaxStride>{});
  }
}

/// Sums over a footprint; gives the weight that it would have without voids.
template <std::size_t Stride>
double integrate_footprint(const Window& window, const MapGeometry& geometry, const Footprint& footprint,
                           const SamplePlace& place, Sum& sum) {
  constexpr int kAtOnce = 16;
  double whole = 0;
  const Lines lines(footprint.min_y(), footprint.max_y());
  const Sides sides(footprint);
  std::array<double, kAtOnce> y, weight;
  for (int begin = 0; begin < lines.count; begin += kAtOnce) {
    const int count = std::min(kAtOnce, lines.count - begin);
    for (int k = 0; k < count; ++k) {
      // Beyond a pole there is no more of the planet; beyond another end of the map there is.
      double& line = y[static_cast<std::size_t>(k)];
      line = lines.y(begin + k);
      if (geometry.north_shift != MapGeometry::kNoPole) line = std::max(line, -0.5);
      if (geometry.south_shift != MapGeometry::kNoPole) line = std::min(line, geometry.height - 0.5);
    }
    row_weights(geometry, y.data(), static_cast<std::size_t>(count), weight.data());
    for (std::size_t line = 0; line < static_cast<std::size_t>(count); ++line) {
      std::array<double, 6> x;
      const int found = sides.crossings(y[line], x);
      for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(found); k += 2) {
        if (x[k + 1] <= x[k]) continue;
        add_strip<Stride>(window, geometry, y[line], place.x.whole + x[k], place.x.whole + x[k + 1],
                          weight[line], sum);
        whole += weight[line] * (x[k + 1] - x[k]);
      }
    }
  }
  return whole;
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
  const double whole = with_stride(window, [&](auto stride) {
    return integrate_footprint<decltype(stride)::value>(window, geometry, footprint, place, sum);
  });
  return whole > 0.0 ? finish(window, channels, sum, whole, out) : bilinear(window, channels, place, out);
}

double cap_mean(const SourceMap& map, double rim, bool north, float* out) {
  const MapGeometry& geometry = map.geometry();
  const Lines lines(north ? -0.5 : rim, north ? rim : geometry.height - 0.5);
  Sum sum{};
  double whole = 0;
  Window window;
  window.width = geometry.period + 1;  // the first column again, to close the circle
  window.height = 2;
  for (int line = 0; line < lines.count; ++line) {
    const double y = lines.y(line);
    window.y0 = static_cast<int>(std::floor(y));
    map.read(window);
    const double weight = row_weight(geometry, y);
    with_stride(window, [&](auto stride) {
      add_strip<decltype(stride)::value>(window, geometry, y, 0.0, geometry.period, weight, sum);
    });
    whole += weight * geometry.period;
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
