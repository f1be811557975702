#include "flat/fractal/ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "flat/fractal/hash.h"

namespace globe::flat::fractal {
namespace {

std::size_t area_of(const PostRect& rect) {
  return static_cast<std::size_t>(rect.columns) * static_cast<std::size_t>(rect.rows);
}

/// Posts of a rectangle by their own numbers.
class Posts {
 public:
  Posts(const PostRect& rect, std::span<const float> heights) : rect_(rect), heights_(heights.data()) {}

  /// Pointer p such that p[i] is post (first_column + i, j).
  const float* row(std::int64_t first_column, std::int64_t j) const {
    assert(j >= rect_.j0 && j < rect_.j0 + rect_.rows && first_column >= rect_.i0);
    return heights_ + (j - rect_.j0) * rect_.columns + (first_column - rect_.i0);
  }

 private:
  PostRect rect_;
  const float* heights_;
};

float mean(float a, float b, float c, float d) { return ((a + b) + (c + d)) * 0.25f; }

}  // namespace

double power_of_half(double h) {
  double power = 1.0;
  double factor = 0.5;  // 2^-1, 2^-1/2, 2^-1/4, ... for each binary digit of h
  for (int digit = 0; digit < 52 && h > 0.0; ++digit) {
    if (h >= 1.0) {
      power *= factor;
      h -= 1.0;
    }
    h *= 2.0;
    factor = std::sqrt(factor);
  }
  return power;
}

Ground::Ground(const Settings& settings) : settings_(settings) {
  check(settings);
  const double shrink = power_of_half(settings.roughness);
  double deviation = settings.relief_m;
  for (int depth = 0; depth <= settings.iterations; ++depth, deviation *= shrink)
    deviations_.push_back(static_cast<float>(deviation));
  base_ = static_cast<float>(settings.base_m);
  contrast_ = static_cast<float>(settings.contrast);
  if (settings.relief_m > 0) per_relief_ = static_cast<float>(0.5 / settings.relief_m);
}

inline float Ground::moved(float height, float deviation, std::uint64_t hash) const {
  // -1 at two deviations below the base, 1 at two above.
  const float above = std::clamp((height - base_) * per_relief_, -1.0f, 1.0f);
  return height + deviation * (1.0f + contrast_ * above) * variate(hash);
}

double Ground::largest_m() const {
  double sum = 0;
  for (const float deviation : deviations_) sum += static_cast<double>(deviation);
  return sum * static_cast<double>(kLargestVariate) * (1.0 + settings_.contrast);
}

PostRect Ground::parents(const PostRect& rect) const {
  const std::int64_t beyond = settings_.method == Method::kSquareSquare ? 0 : 1;
  const std::int64_t i0 = (rect.i0 - beyond) >> 1;
  const std::int64_t j0 = (rect.j0 - beyond) >> 1;
  const std::int64_t i1 = ((rect.i0 + rect.columns - 1) >> 1) + 1;
  const std::int64_t j1 = ((rect.j0 + rect.rows - 1) >> 1) + 1;
  return {i0, j0, static_cast<int>(i1 - i0) + 1, static_cast<int>(j1 - j0) + 1, 1};
}

void Ground::heights(int depth, const PostRect& rect, std::span<float> out, Workspace& workspace) const {
  PostRect known = rect;
  for (int d = depth; d > 0; --d) known = parents(known);
  if (depth == 0) {
    roots(rect, out);
    return;
  }
  std::vector<float>& corners = workspace.posts[0];
  corners.resize(std::max(corners.size(), area_of(known)));
  roots(known, corners);
  heights_from(0, known, corners, depth, rect, out, workspace);
}

void Ground::heights_from(int known_depth, const PostRect& known, std::span<const float> known_heights,
                          int depth, const PostRect& rect, std::span<float> out, Workspace& workspace) const {
  assert(rect.stride == 1 && known_depth <= depth && depth <= settings_.iterations);
  if (known_depth == depth) {
    const Posts posts(known, known_heights);
    for (int j = 0; j < rect.rows; ++j)
      std::copy_n(posts.row(rect.i0, rect.j0 + j), rect.columns,
                  out.data() + std::ptrdiff_t{j} * rect.columns);
    return;
  }
  std::array<PostRect, 25> chain;  // chain[d]: what is needed of depth d
  chain[static_cast<std::size_t>(depth)] = rect;
  for (int d = depth; d > known_depth + 1; --d)
    chain[static_cast<std::size_t>(d) - 1] = parents(chain[static_cast<std::size_t>(d)]);
  PostRect coarse = known;
  std::span<const float> coarse_heights = known_heights;
  for (int d = known_depth + 1; d <= depth; ++d) {
    const PostRect& wanted = chain[static_cast<std::size_t>(d)];
    std::span<float> target = out;
    if (d < depth) {
      // Never the buffer that the coarser posts lie in; `known_heights` may lie in the first.
      std::vector<float>& room = workspace.posts[static_cast<std::size_t>((d - known_depth) % 2)];
      room.resize(std::max(room.size(), area_of(wanted)));
      target = room;
    }
    refine(d, coarse, coarse_heights, wanted, target, workspace);
    coarse = wanted;
    coarse_heights = target;
  }
}

void Ground::roots(const PostRect& rect, std::span<float> out) const {
  const float deviation = deviation_m(0);
  float* to = out.data();
  for (std::int64_t j = rect.j0; j < rect.j0 + rect.rows; ++j) {
    const std::uint64_t row = row_key(settings_.seed, 0, j);
    for (std::int64_t i = rect.i0; i < rect.i0 + rect.columns; ++i)
      *to++ = base_ + deviation * variate(post_hash(row, i));
  }
}

void Ground::refine(int depth, const PostRect& coarse, std::span<const float> coarse_heights,
                    const PostRect& rect, std::span<float> out, Workspace& workspace) const {
  if (settings_.method == Method::kSquareSquare) {
    refine_squares(depth, coarse, coarse_heights, rect, out);
  } else {
    refine_diamonds(depth, coarse, coarse_heights, rect, out, workspace);
  }
}

void Ground::refine_diamonds(int depth, const PostRect& coarse, std::span<const float> coarse_heights,
                             const PostRect& rect, std::span<float> out, Workspace& workspace) const {
  const Posts posts(coarse, coarse_heights);
  const float deviation = deviation_m(depth);
  // Middles of cells: odd columns from first_middle on, of the odd row below and the odd row above.
  const std::int64_t first_middle = (rect.i0 - 1) | 1;
  const std::int64_t last_middle = (rect.i0 + rect.columns - 1) | 1;
  const auto count = static_cast<std::size_t>((last_middle - first_middle) / 2 + 1);
  for (std::vector<float>& row : workspace.middles) row.resize(std::max(row.size(), count));
  float* below = workspace.middles[0].data();
  float* above = workspace.middles[1].data();
  const auto make_middles = [&](std::int64_t j, float* to) {
    const float* south = posts.row(first_middle >> 1, j >> 1);
    const float* north = posts.row(first_middle >> 1, (j >> 1) + 1);
    const std::uint64_t row = row_key(settings_.seed, depth, j);
    for (std::size_t k = 0; k < count; ++k) {
      to[k] = moved(mean(south[k], south[k + 1], north[k], north[k + 1]), deviation,
                    post_hash(row, first_middle + 2 * static_cast<std::int64_t>(k)));
    }
  };
  make_middles((rect.j0 - 1) | 1, above);
  for (std::int64_t j = rect.j0; j < rect.j0 + rect.rows; ++j) {
    float* to = out.data() + (j - rect.j0) * rect.columns;
    const std::uint64_t row = row_key(settings_.seed, depth, j);
    const bool even_row = (j & 1) == 0;
    if (even_row) {
      std::swap(below, above);
      make_middles(j + 1, above);
    }
    const float* south = posts.row(coarse.i0, j >> 1);
    const float* north = even_row ? south : posts.row(coarse.i0, (j >> 1) + 1);
    for (std::int64_t i = rect.i0; i < rect.i0 + rect.columns; ++i, ++to) {
      const std::int64_t k = (i >> 1) - coarse.i0;                  // the coarse post at or west of i
      const std::int64_t m = ((i - 1) >> 1) - (first_middle >> 1);  // the middle west of i, or at it
      const bool even_column = (i & 1) == 0;
      if (even_row && even_column) {
        *to = south[k];
      } else if (even_row) {
        *to = moved(mean(south[k], south[k + 1], below[m], above[m]), deviation, post_hash(row, i));
      } else if (even_column) {
        *to = moved(mean(above[m], above[m + 1], south[k], north[k]), deviation, post_hash(row, i));
      } else {
        *to = above[m];
      }
    }
  }
}

void Ground::refine_squares(int depth, const PostRect& coarse, std::span<const float> coarse_heights,
                            const PostRect& rect, std::span<float> out) const {
  const Posts posts(coarse, coarse_heights);
  const float deviation = deviation_m(depth);
  for (std::int64_t j = rect.j0; j < rect.j0 + rect.rows; ++j) {
    float* to = out.data() + (j - rect.j0) * rect.columns;
    const std::uint64_t row = row_key(settings_.seed, depth, j);
    // The nearer coarse row and column count three times.
    const float* near = posts.row(coarse.i0, (j >> 1) + (j & 1));
    const float* far = posts.row(coarse.i0, (j >> 1) + 1 - (j & 1));
    for (std::int64_t i = rect.i0; i < rect.i0 + rect.columns; ++i, ++to) {
      const std::int64_t k = (i >> 1) - coarse.i0;
      const std::int64_t x = k + (i & 1), y = k + 1 - (i & 1);
      const float middle = (9.0f * near[x] + 3.0f * (near[y] + far[x]) + far[y]) * 0.0625f;
      *to = moved(middle, deviation, post_hash(row, i));
    }
  }
}

void FractalSource::posts(const PostRect& rect, std::span<float> heights_m) const {
  Ground::Workspace workspace;
  const int depth = ground_.settings().iterations;
  if (rect.stride == 1) {
    ground_.heights(depth, rect, heights_m, workspace);
    return;
  }
  // In pieces of about 128 posts a side, of which every stride-th is kept; one post each for wide strides.
  const int piece = std::max(1, 128 / rect.stride);
  std::vector<float> all;
  for (int row = 0; row < rect.rows; row += piece) {
    for (int column = 0; column < rect.columns; column += piece) {
      const int columns = std::min(piece, rect.columns - column);
      const int rows = std::min(piece, rect.rows - row);
      const PostRect dense{rect.i0 + std::int64_t{column} * rect.stride,
                           rect.j0 + std::int64_t{row} * rect.stride, (columns - 1) * rect.stride + 1,
                           (rows - 1) * rect.stride + 1, 1};
      all.resize(area_of(dense));
      ground_.heights(depth, dense, all, workspace);
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
          heights_m[static_cast<std::size_t>(row + j) * static_cast<std::size_t>(rect.columns) +
                    static_cast<std::size_t>(column + i)] =
              all[static_cast<std::size_t>(j * rect.stride) * static_cast<std::size_t>(dense.columns) +
                  static_cast<std::size_t>(i * rect.stride)];
        }
      }
    }
  }
}

}  // namespace globe::flat::fractal
