#include "converters/void_fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <istream>
#include <ostream>

namespace converters {
namespace {

constexpr int kMaxColumns = 4096;
constexpr std::size_t kFilledChannels = 4;

int blocks(int samples, int factor) { return (samples + factor - 1) / factor; }

}  // namespace

float* VoidFill::Grid::at(int x, int y, int stride) {
  return values.data() +
         (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
             static_cast<std::size_t>(stride);
}
const float* VoidFill::Grid::at(int x, int y, int stride) const {
  return const_cast<Grid*>(this)->at(x, y, stride);
}

VoidFill::VoidFill(const MapGeometry& geometry, int channels)
    : channels_(channels),
      stride_(channels + 1),
      factor_(blocks(std::max(geometry.columns(), geometry.height), kMaxColumns)),
      wraps_(geometry.period > 0) {
  grid_ = {blocks(geometry.columns(), factor_), blocks(geometry.height, factor_), {}};
  grid_.values.resize(static_cast<std::size_t>(grid_.width) * static_cast<std::size_t>(grid_.height) *
                      static_cast<std::size_t>(stride_));
}

void VoidFill::add(int x, int y, const float* value) {
  float* block = grid_.at(x / factor_, y / factor_, stride_);
  for (int c = 0; c < channels_; ++c) block[c] += value[c];
  block[channels_] += 1.0F;
}

VoidFill::Grid VoidFill::coarser(const Grid& fine) const {
  Grid coarse{blocks(fine.width, 2), blocks(fine.height, 2), {}};
  coarse.values.resize(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height) *
                       static_cast<std::size_t>(stride_));
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const float* from = fine.at(x, y, stride_);
      float* to = coarse.at(x / 2, y / 2, stride_);
      if (from[channels_] == 0.0F) continue;
      for (int c = 0; c < channels_; ++c) to[c] += from[c];
      to[channels_] += 1.0F;
    }
  }
  for (std::size_t k = 0; k < coarse.values.size(); k += static_cast<std::size_t>(stride_)) {
    float* block = coarse.values.data() + k;
    for (int c = 0; c < channels_ && block[channels_] > 0.0F; ++c) block[c] /= block[channels_];
  }
  return coarse;
}

void VoidFill::fill_from(const Grid& coarse, Grid& fine) const {
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      float* to = fine.at(x, y, stride_);
      if (to[channels_] > 0.0F) continue;
      interpolate(blocks_of(coarse), (x - 0.5) / 2.0, (y - 0.5) / 2.0, to);
      to[channels_] = 1.0F;
    }
  }
}

void VoidFill::finish(MemoryBudget& budget) {
  for (std::size_t k = 0; k < grid_.values.size(); k += static_cast<std::size_t>(stride_)) {
    float* block = grid_.values.data() + k;
    for (int c = 0; c < channels_ && block[channels_] > 0.0F; ++c) block[c] /= block[channels_];
  }
  std::vector<Grid> pyramid{std::move(grid_)};
  while (pyramid.back().width > 1 || pyramid.back().height > 1) pyramid.push_back(coarser(pyramid.back()));
  for (std::size_t k = pyramid.size() - 1; k-- > 0;) fill_from(pyramid[k + 1], pyramid[k]);
  grid_ = std::move(pyramid.front());
  pyramid.clear();
  const std::size_t blocks = grid_.values.size() / static_cast<std::size_t>(stride_);
  filled_ = Buffer(blocks * static_cast<std::size_t>(channels_) * sizeof(float), budget);
  float* to = filled_.as<float>();
  for (std::size_t k = 0; k < blocks; ++k, to += channels_)
    std::copy_n(grid_.values.data() + k * static_cast<std::size_t>(stride_), channels_, to);
  grid_.values = {};
}

/// Bilinear between block centres; columns wrap or are held at the ends, rows are held at theirs.
void VoidFill::interpolate(const Blocks& grid, double x, double y, float* out) const {
  const double left = std::floor(x);
  const double top = std::floor(y);
  const std::array<double, 2> wx{1.0 - (x - left), x - left};
  const std::array<double, 2> wy{1.0 - (y - top), y - top};
  std::array<double, kFilledChannels> sum{};
  for (int b = 0; b < 2; ++b) {
    const int row = std::clamp(static_cast<int>(top) + b, 0, grid.height - 1);
    for (int a = 0; a < 2; ++a) {
      const int wanted = static_cast<int>(left) + a;
      const int column =
          wraps_ ? (wanted + 2 * grid.width) % grid.width : std::clamp(wanted, 0, grid.width - 1);
      const float* from = grid.at(column, row);
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c)
        sum[c] +=
            wx[static_cast<std::size_t>(a)] * wy[static_cast<std::size_t>(b)] * static_cast<double>(from[c]);
    }
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) out[c] = static_cast<float>(sum[c]);
}

void VoidFill::value(const SamplePlace& place, float* out) const {
  const auto block = [&](const SampleCoordinate& at) {
    return (at.whole + at.fraction + 0.5) / factor_ - 0.5;
  };
  interpolate({grid_.width, grid_.height, channels_, filled_.as<float>()}, block(place.x), block(place.y),
              out);
}

void VoidFill::save(std::ostream& stream) const {
  stream.write(reinterpret_cast<const char*>(filled_.data()), static_cast<std::streamsize>(filled_.size()));
}

void VoidFill::load(std::istream& stream, MemoryBudget& budget) {
  filled_ = Buffer(grid_.values.size() / static_cast<std::size_t>(stride_) *
                       static_cast<std::size_t>(channels_) * sizeof(float),
                   budget);
  grid_.values = {};
  stream.read(reinterpret_cast<char*>(filled_.data()), static_cast<std::streamsize>(filled_.size()));
}

}  // namespace converters
