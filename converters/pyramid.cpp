#include "converters/pyramid.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "converters/srgb.h"
#include "globe/planet/lattice_trixel.h"
#include "globe/planet/mean_height.h"

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

/// Directions of the nodes of row j.
std::vector<globe::planet::dvec3> row_directions(int d, int level, int j) {
  std::vector<globe::planet::dvec3> row;
  for (int i = 0; i <= globe::planet::nodes_per_side(level); ++i)
    row.push_back(globe::planet::node_direction({d, level, i, j}));
  return row;
}

/// Calls mean(trixel, corners) for both halves of each cell in row j of a grid of means, and repeats the last
/// cell.
template <typename Mean>
void fill_means(int d, int j, NodeGrid<float>& means, const Mean& mean) {
  const int last = means.side() - 2;
  const int cell_j = std::min(j, last);
  const auto low = row_directions(d, means.level(), cell_j),
             high = row_directions(d, means.level(), cell_j + 1);
  for (int i = 0; i <= last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    float* out = means.at(d, i, j);
    out[0] = static_cast<float>(mean(globe::planet::lattice_trixel(d, means.level(), i, cell_j, 0),
                                     globe::htm::Corners{low[k], low[k + 1], high[k]}));
    out[1] = static_cast<float>(mean(globe::planet::lattice_trixel(d, means.level(), i, cell_j, 1),
                                     globe::htm::Corners{high[k + 1], high[k], low[k + 1]}));
  }
  std::copy_n(means.at(d, last, j), 2, means.at(d, last + 1, j));
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

void mean_of_heights(const NodeGrid<float>& heights, const globe::geo::Ellipsoid& ellipsoid,
                     NodeGrid<float>& means) {
  assert(means.level() == globe::planet::block_level(heights.level()) && means.channels() == 2);
  for_each_row(heights, means, [&](int d, int j) {
    globe::planet::HeightBlock block;
    block.d = d;
    block.height_level = heights.level();
    const int cells = block.cells();
    block.j0 = std::min(j, means.side() - 2) * cells;
    fill_means(d, j, means, [&](const globe::planet::LatticeTrixel& t, const globe::htm::Corners& corners) {
      block.i0 = t.cell_i() * cells;
      for (int y = 0; y <= cells; ++y) {
        const float* from = heights.at(d, block.i0, block.j0 + y);
        std::copy_n(from, cells + 1, &block.at(block.i0, block.j0 + y));
      }
      return globe::planet::mean_height(ellipsoid, block, t, corners);
    });
  });
}

void mean_of_means(const NodeGrid<float>& fine, const globe::geo::Ellipsoid& ellipsoid,
                   NodeGrid<float>& coarse) {
  assert(fine.level() == coarse.level() + 1 && fine.channels() == 2 && coarse.channels() == 2);
  for_each_row(fine, coarse, [&](int d, int j) {
    fill_means(d, j, coarse, [&](const globe::planet::LatticeTrixel& t, const globe::htm::Corners& corners) {
      std::array<double, 4> means{};
      const auto parts = children(t);
      std::transform(parts.begin(), parts.end(), means.begin(), [&](const auto& part) {
        return static_cast<double>(fine.at(d, part.cell_i(), part.cell_j())[part.half()]);
      });
      return globe::planet::mean_of_children(ellipsoid, corners, means);
    });
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
