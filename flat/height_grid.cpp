#include "flat/height_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <utility>

namespace globe::flat {
namespace {

constexpr double kReference = 5000.0;  ///< metres: between it and 0 normals over a place are interpolated

void sample_row(const TangentFrame& frame, double spacing_m, const PostRect& rect, int row,
                const GroundHeights& ground, double close_m, std::span<float> heights) {
  const auto columns = static_cast<std::size_t>(rect.columns);
  std::vector<dvec3> feet(columns), turns(columns), normals(columns);
  std::vector<float> before(columns);
  const double y = static_cast<double>(rect.j0 + row) * spacing_m;
  for (std::size_t c = 0; c < columns; ++c) {
    const double x = static_cast<double>(rect.i0 + static_cast<std::int64_t>(c)) * spacing_m;
    feet[c] = frame.normal_at(x, y, 0.0);
    turns[c] = (frame.normal_at(x, y, kReference) - feet[c]) / kReference;
  }
  ground(feet, heights);
  for (int pass = 1; pass < 5; ++pass) {
    std::copy(heights.begin(), heights.end(), before.begin());
    for (std::size_t c = 0; c < columns; ++c)
      normals[c] = glm::normalize(feet[c] + turns[c] * static_cast<double>(heights[c]));
    ground(normals, heights);
    double moved = 0.0;
    for (std::size_t c = 0; c < columns; ++c)
      moved = std::max(moved, static_cast<double>(std::abs(heights[c] - before[c])));
    if (moved < close_m) break;
  }
}

}  // namespace

HeightGrid::HeightGrid(double spacing_m, const PostRect& extent, std::vector<float> heights_m)
    : spacing_m_(spacing_m), extent_(extent), heights_m_(std::move(heights_m)) {
  assert(heights_m_.size() ==
         static_cast<std::size_t>(extent.columns) * static_cast<std::size_t>(extent.rows));
}

void HeightGrid::posts(const PostRect& rect, std::span<float> heights_m) const {
  std::size_t out = 0;
  for (int r = 0; r < rect.rows; ++r) {
    const std::int64_t j = rect.j0 - extent_.j0 + std::int64_t{r} * rect.stride;
    for (int c = 0; c < rect.columns; ++c) {
      const std::int64_t i = rect.i0 - extent_.i0 + std::int64_t{c} * rect.stride;
      assert(i >= 0 && j >= 0 && i < extent_.columns && j < extent_.rows);
      heights_m[out++] = heights_m_[static_cast<std::size_t>(j * extent_.columns + i)];
    }
  }
}

HeightGrid sample_ground(const TangentFrame& frame, double spacing_m, const PostRect& rect,
                         const GroundHeights& ground, double close_m,
                         const std::function<void(double)>& progress) {
  const auto columns = static_cast<std::size_t>(rect.columns);
  std::vector<float> heights(columns * static_cast<std::size_t>(rect.rows));
  std::mutex telling;
  int done = 0;
  tbb::parallel_for(0, rect.rows, [&](int row) {
    sample_row(frame, spacing_m, rect, row, ground, close_m,
               std::span(heights).subspan(static_cast<std::size_t>(row) * columns, columns));
    if (!progress) return;
    const std::lock_guard lock(telling);
    progress(static_cast<double>(++done) / rect.rows);
  });
  return {spacing_m, rect, std::move(heights)};
}

}  // namespace globe::flat
