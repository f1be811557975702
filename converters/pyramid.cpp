#include "converters/pyramid.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

#include "converters/srgb.h"

namespace converters {
namespace {

using globe::planet::fold;
using globe::planet::kDiamonds;
using globe::planet::Node;

constexpr std::size_t kMaxChannels = 4;

/// Runs body(d, j) for every row of the grid `to`, which is made from `from`; lets go of pages on the way
/// when the grids lie in files.
template <typename From, typename To, typename Body>
void for_each_row(const NodeGrid<From>& from, const NodeGrid<To>& to, const Body& body) {
  constexpr int kRowsATask = 16;
  constexpr int kTasksBetweenDrops = 16;
  const int side = to.side();
  std::atomic<int> tasks = 0;
  const tbb::blocked_range<int> all(0, kDiamonds * side, kRowsATask);
  const auto run = [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row < rows.end(); ++row) body(row / side, row % side);
    if (++tasks % kTasksBetweenDrops == 0) {
      from.drop_pages();
      to.drop_pages();
    }
  };
  tbb::parallel_for(all, run, tbb::simple_partitioner{});
  from.drop_pages();
  to.drop_pages();
}

constexpr std::array<globe::planet::ivec2, 6> kAround{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};

/// Filtered value at a node on a diamond's border, the same from each diamond that has it: sums in the order
/// of the name with the smallest diamond, each neighbour taken once.
void filter_border(const NodeGrid<float>& fine, const Node& coarse_node, float* out) {
  const globe::planet::Names all =
      globe::planet::names({coarse_node.d, fine.level(), 2 * coarse_node.i, 2 * coarse_node.j});
  const Node node =
      *std::min_element(all.node.begin(), all.node.begin() + all.count, [](const Node& a, const Node& b) {
        return std::array{a.d, a.i, a.j} < std::array{b.d, b.i, b.j};
      });
  std::array<globe::planet::ivec3, 6> seen{};
  std::array<double, kMaxChannels> sum{};
  const auto channels = static_cast<std::size_t>(fine.channels());
  std::size_t count = 0;
  for (const auto& step : kAround) {
    const Node neighbor = fold({node.d, node.level, node.i + step.x, node.j + step.y});
    const globe::planet::ivec3 key = globe::planet::octahedral_key(neighbor);
    if (std::find(seen.begin(), seen.begin() + count, key) != seen.begin() + count) continue;
    seen[count++] = key;
    const float* value = fine.at(neighbor.d, neighbor.i, neighbor.j);
    for (std::size_t c = 0; c < channels; ++c) sum[c] += static_cast<double>(value[c]);
  }
  const float* own = fine.at(node.d, node.i, node.j);
  for (std::size_t c = 0; c < channels; ++c)
    out[c] =
        static_cast<float>((2.0 * static_cast<double>(own[c]) + sum[c]) / (2.0 + static_cast<double>(count)));
}

void include(const float* low_high, float* range) {
  range[0] = std::min(range[0], low_high[0]);
  range[1] = std::max(range[1], low_high[1]);
}

}  // namespace

void subsample(const NodeGrid<float>& fine, NodeGrid<float>& coarse) {
  assert(fine.level() == coarse.level() + 1 && fine.channels() == coarse.channels());
  const int channels = fine.channels();
  for_each_row(fine, coarse, [&](int d, int j) {
    for (int i = 0; i < coarse.side(); ++i)
      std::copy_n(fine.at(d, 2 * i, 2 * j), channels, coarse.at(d, i, j));
  });
}

void filter(const NodeGrid<float>& fine, NodeGrid<float>& coarse) {
  assert(fine.level() == coarse.level() + 1 && fine.channels() == coarse.channels());
  const int last = coarse.side() - 1;
  const int channels = fine.channels();
  const std::ptrdiff_t row = std::ptrdiff_t{fine.side()} * channels;
  for_each_row(fine, coarse, [&](int d, int j) {
    for (int i = 0; i <= last; ++i) {
      float* out = coarse.at(d, i, j);
      if (i == 0 || j == 0 || i == last || j == last) {
        filter_border(fine, {d, coarse.level(), i, j}, out);
        continue;
      }
      const float* own = fine.at(d, 2 * i, 2 * j);
      for (int c = 0; c < channels; ++c, ++own) {
        const float around =
            own[channels] + own[-channels] + own[row] + own[-row] + own[channels - row] + own[row - channels];
        out[c] = 0.25F * own[0] + 0.125F * around;
      }
    }
  });
}

void range_of_heights(const NodeGrid<float>& heights, NodeGrid<float>& ranges) {
  const int cells = 1 << (heights.level() - ranges.level());
  const int last = ranges.side() - 2;
  for_each_row(heights, ranges, [&](int d, int j) {
    for (int i = 0; i < ranges.side(); ++i) {
      float* out = ranges.at(d, i, j);
      out[0] = std::numeric_limits<float>::max();
      out[1] = std::numeric_limits<float>::lowest();
      const int i0 = std::min(i, last) * cells;
      const int j0 = std::min(j, last) * cells;
      for (int y = j0; y <= j0 + cells; ++y) {
        const float* from = heights.at(d, i0, y);
        const auto [low, high] = std::minmax_element(from, from + cells + 1);
        const std::array<float, 2> both{*low, *high};
        include(both.data(), out);
      }
    }
  });
}

void range_of_ranges(const NodeGrid<float>& fine, NodeGrid<float>& coarse) {
  const int last = coarse.side() - 2;
  for_each_row(fine, coarse, [&](int d, int j) {
    for (int i = 0; i < coarse.side(); ++i) {
      const int i0 = 2 * std::min(i, last);
      const int j0 = 2 * std::min(j, last);
      float* out = coarse.at(d, i, j);
      std::copy_n(fine.at(d, i0, j0), 2, out);
      include(fine.at(d, i0 + 1, j0), out);
      include(fine.at(d, i0, j0 + 1), out);
      include(fine.at(d, i0 + 1, j0 + 1), out);
    }
  });
}

void decode_colors(const NodeGrid<std::uint8_t>& bytes, NodeGrid<float>& linear) {
  std::array<float, 256> table{};
  for (std::size_t c = 0; c < table.size(); ++c)
    table[c] = static_cast<float>(linear_from_srgb(double(c) / 255.0));
  const int count = bytes.side() * bytes.channels();
  for_each_row(bytes, linear, [&](int d, int j) {
    const std::uint8_t* from = bytes.at(d, 0, j);
    std::transform(from, from + count, linear.at(d, 0, j), [&](std::uint8_t byte) { return table[byte]; });
  });
}

void encode_colors(const NodeGrid<float>& linear, NodeGrid<std::uint8_t>& bytes) {
  const int count = bytes.side() * bytes.channels();
  for_each_row(linear, bytes, [&](int d, int j) {
    const float* from = linear.at(d, 0, j);
    std::transform(from, from + count, bytes.at(d, 0, j), srgb_byte_from_linear);
  });
}

Range range(const NodeGrid<float>& grid) {
  // Minimum and maximum do not depend on the order, so a plain reduction will do.
  const Range none{HUGE_VAL, -HUGE_VAL};
  const auto join = [](const Range& a, const Range& b) {
    return Range{std::min(a.min, b.min), std::max(a.max, b.max)};
  };
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, kDiamonds * grid.side(), 16), none,
      [&](const tbb::blocked_range<int>& rows, Range found) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
          const float* from = grid.at(row / grid.side(), 0, row % grid.side());
          const auto [low, high] = std::minmax_element(from, from + grid.side() * grid.channels());
          found = join(found, {static_cast<double>(*low), static_cast<double>(*high)});
        }
        grid.drop_pages();
        return found;
      },
      join);
}

}  // namespace converters
