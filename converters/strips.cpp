#include "converters/strips.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "globe/base/vector_width.h"

namespace converters {
namespace {

constexpr std::size_t kLanes = Window::kPadding;  ///< columns at a time
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using SampleLanes = float __attribute__((vector_size(kLanes * sizeof(float))));

/// The row at or above a strip.
int row_of(const Strip& strip) {
  const int row = static_cast<int>(strip.y);
  return row > strip.y ? row - 1 : row;
}

/// Strips that lie between the same two rows are summed first, by column.
///
/// The integral of a sample's hat, 1 - |t|, from -1 to t is (1 + t (2 - |t|)) / 2.
GLOBE_FOR_EVERY_VECTOR_WIDTH
void add(const Window& window, int origin, int first_column, int last_column, const Strip* strips,
         std::size_t count, ChannelSums& sums) {
  const auto stride = static_cast<std::size_t>(window.stride);
  Lanes sum{};
  for (int column = first_column; column <= last_column; column += static_cast<int>(kLanes)) {
    const Lanes columns = static_cast<double>(column) + Lanes{0, 1, 2, 3, 4, 5, 6, 7};
    for (std::size_t s = 0; s < count;) {
      const int row = row_of(strips[s]);
      Lanes top{}, bottom{};  // twice the weights of two rows' samples
      for (; s < count && row_of(strips[s]) == row; ++s) {
        const Strip& strip = strips[s];
        const double lower = strip.y - row;
        Lanes a = strip.a - columns, b = strip.b - columns;
        a = a < -1.0 ? Lanes{} - 1.0 : a;
        a = a > 1.0 ? Lanes{} + 1.0 : a;
        b = b < -1.0 ? Lanes{} - 1.0 : b;
        b = b > 1.0 ? Lanes{} + 1.0 : b;
        const Lanes length = b * (2.0 - (b < 0.0 ? -b : b)) - a * (2.0 - (a < 0.0 ? -a : a));
        top += strip.weight * (1.0 - lower) * length;
        bottom += strip.weight * lower * length;
      }
      const float* upper = window.at(origin + column, row);
      const float* under = window.at(origin + column, row + 1);
      if (stride == 1) {
        SampleLanes of_upper, of_under;
        std::memcpy(&of_upper, upper, sizeof of_upper);
        std::memcpy(&of_under, under, sizeof of_under);
        sum += top * __builtin_convertvector(of_upper, Lanes) +
               bottom * __builtin_convertvector(of_under, Lanes);
        continue;
      }
      for (std::size_t k = 0; k < kLanes; ++k) {
        for (std::size_t c = 0; c < stride; ++c) {
          sums[c] += 0.5 * (top[k] * static_cast<double>(upper[k * stride + c]) +
                            bottom[k] * static_cast<double>(under[k * stride + c]));
        }
      }
    }
  }
  sums[0] += 0.5 * (((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])));
}

}  // namespace

void add_strips(const Window& window, int origin, const Strip* strips, std::size_t count, ChannelSums& sums) {
  double left = strips[0].a, right = strips[0].b;
  for (std::size_t s = 1; s < count; ++s) {
    left = std::min(left, strips[s].a);
    right = std::max(right, strips[s].b);
  }
  add(window, origin, static_cast<int>(std::floor(left)), static_cast<int>(std::floor(right)) + 1, strips,
      count, sums);
}

}  // namespace converters
