#include "globe/scene/monotone_cubic.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace globe::scene {
namespace {

/// Slope at an end from those of the two pieces there, by a parabola, kept from overshooting.
double end_slope(double h0, double h1, double d0, double d1) {
  const double slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0.0) return 0.0;
  return d0 * d1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(d0) ? 3.0 * d0 : slope;
}

}  // namespace

std::size_t piece_at(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, time);
  return static_cast<std::size_t>(after - times.begin()) - 1;
}

MonotoneCubic::MonotoneCubic(std::vector<double> times, std::vector<double> values,
                             const std::vector<bool>& stops)
    : times_(std::move(times)), values_(std::move(values)), slopes_(times_.size()) {
  const std::size_t n = times_.size();
  std::vector<double> h(n - 1), d(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    h[k] = times_[k + 1] - times_[k];
    d[k] = (values_[k + 1] - values_[k]) / h[k];
  }
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (d[k - 1] * d[k] <= 0.0) continue;
    const double w1 = 2.0 * h[k] + h[k - 1], w2 = h[k] + 2.0 * h[k - 1];
    slopes_[k] = (w1 + w2) / (w1 / d[k - 1] + w2 / d[k]);
  }
  slopes_.front() = n == 2 ? d[0] : end_slope(h[0], h[1], d[0], d[1]);
  slopes_.back() = n == 2 ? d[0] : end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  for (std::size_t k = 0; k < n; ++k) {
    if (stops[k]) slopes_[k] = 0.0;
  }
}

double MonotoneCubic::at(double time) const {
  if (time <= times_.front()) return values_.front();
  if (time >= times_.back()) return values_.back();
  const std::size_t k = piece_at(times_, time);
  const double h = times_[k + 1] - times_[k];
  const double x = (time - times_[k]) / h;
  const double rise = values_[k + 1] - values_[k];
  const double blend = x * x * (3.0 - 2.0 * x);
  return values_[k] + rise * blend + h * x * (1.0 - x) * ((1.0 - x) * slopes_[k] - x * slopes_[k + 1]);
}

}  // namespace globe::scene
