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

#include "converters/border_filter.h"
#include "converters/srgb.h"
#include "globe/planet/lattice_trixel.h"
#include "globe/planet/mean_height.h"

namespace converters {
namespace {

using globe::planet::kDiamonds;
using globe::planet::Node;

/// Runs body(d, j) for every row of the grid `to`, which is made from `from`; lets go of pages on the way
/// when the grids lie in files.
template <typename From, typename To, typename Body>
void for_each_row(const NodeGrid<From>& from, const NodeGrid<To>& to, const Body& body) {
  constexpr int kRowsATask = 16;
  constexpr std::size_t kBytesBetweenDrops = std::size_t{8} << 20;
  const int side = to.side();
  const std::size_t task_bytes = static_cast<std::size_t>(kRowsATask) * 2 *
                                 static_cast<std::size_t>(from.side()) *
                                 static_cast<std::size_t>(from.channels()) * sizeof(From);
  const int between_drops = static_cast<int>(std::max<std::size_t>(1, kBytesBetweenDrops / task_bytes));
  std::atomic<int> tasks = 0;
  const tbb::blocked_range<int> all(0, kDiamonds * side, kRowsATask);
  const auto run = [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row < rows.end(); ++row) body(row / side, row % side);
    if (++tasks % between_drops == 0) {
      from.drop_pages();
      to.drop_pages();
    }
  };
  tbb::parallel_for(all, run, tbb::simple_partitioner{});
  from.drop_pages();
  to.drop_pages();
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
  const auto at = [&](const Node& node) { return fine.at(node.d, node.i, node.j); };
  constexpr int kColumnNodes = 64;
  for_each_row(fine, coarse, [&](int d, int j) {
    for (int i = 0; i <= last; ++i) {
      float* out = coarse.at(d, i, j);
      // The neighbours of a diamond's first and last row stand in a column of the next: a page for each.
      if ((j == 0 || j == last) && i % kColumnNodes == 0) fine.drop_pages();
      if (i == 0 || j == 0 || i == last || j == last) {
        filter_border({d, fine.level(), 2 * i, 2 * j}, static_cast<std::size_t>(channels), at, out);
      } else {
        filter_inside(fine.at(d, 2 * i, 2 * j), channels, row, out);
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

namespace {

template <typename Encode>
void encode(const NodeGrid<float>& values, NodeGrid<std::uint8_t>& bytes, const Encode& byte_of) {
  const int count = bytes.side() * bytes.channels();
  for_each_row(values, bytes, [&](int d, int j) {
    const float* from = values.at(d, 0, j);
    std::transform(from, from + count, bytes.at(d, 0, j), byte_of);
  });
}

}  // namespace

void encode_colors(const NodeGrid<float>& linear, NodeGrid<std::uint8_t>& bytes) {
  encode(linear, bytes, srgb_byte_from_linear);
}

void encode_marks(const NodeGrid<float>& marks, NodeGrid<std::uint8_t>& bytes) {
  encode(marks, bytes, mark_byte);
}

}  // namespace converters
