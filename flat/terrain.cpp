#include "flat/terrain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace globe::flat {
namespace {

/// How finely z is stored: a float holds such steps up to 16 km.
constexpr double kStepsAMetre = 1024.0;

/// z of the mesh of a level over a post of level 0, both counted in a patch.
double mesh_z(const Terrain& terrain, int first_column, int first_row, int level, int column, int row) {
  const int step = 1 << level;
  const int last = kPatchCells / step - 1;
  const int i = std::min(column / step, last);
  const int j = std::min(row / step, last);
  const auto z = [&](int di, int dj) {
    return static_cast<double>(terrain.z(first_column + (i + di) * step, first_row + (j + dj) * step));
  };
  return in_cell({z(0, 0), z(1, 0), z(0, 1), z(1, 1)}, splits_north_east(i, j),
                 static_cast<double>(column - i * step) / step, static_cast<double>(row - j * step) / step);
}

/// Whether a post lies in a quarter or on its border.
bool touches(std::size_t quarter, int column, int row) {
  constexpr int kHalf = kPatchCells / 2;
  return (quarter % 2 == 0 ? column <= kHalf : column >= kHalf) &&
         (quarter / 2 == 0 ? row <= kHalf : row >= kHalf);
}

PatchSummary summary_of(const Terrain& terrain, int patch_column, int patch_row) {
  PatchSummary summary;
  const int first_column = patch_column * kPatchCells;
  const int first_row = patch_row * kPatchCells;
  summary.lowest_m = summary.highest_m = terrain.z(first_column, first_row);
  for (int row = 0; row <= kPatchCells; ++row) {
    for (int column = 0; column <= kPatchCells; ++column) {
      const float z = terrain.z(first_column + column, first_row + row);
      summary.lowest_m = std::min(summary.lowest_m, z);
      summary.highest_m = std::max(summary.highest_m, z);
      for (std::size_t level = 1; level < kLevels; ++level) {
        const double mesh = mesh_z(terrain, first_column, first_row, static_cast<int>(level), column, row);
        const auto error = static_cast<float>(std::abs(mesh - static_cast<double>(z)));
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
          if (!touches(quarter, column, row)) continue;
          float& largest = summary.errors_m[quarter][level];
          largest = std::max(largest, error);
        }
      }
    }
  }
  for (LevelErrors& errors : summary.errors_m) {
    for (std::size_t level = 1; level < kLevels; ++level)
      errors[level] = std::max(errors[level], errors[level - 1]);
  }
  return summary;
}

}  // namespace

double in_cell(const std::array<double, 4>& corners, bool north_east, double u, double v) {
  const auto [sw, se, nw, ne] = corners;
  if (north_east) return u >= v ? sw + u * (se - sw) + v * (ne - se) : sw + v * (nw - sw) + u * (ne - nw);
  return u + v <= 1.0 ? sw + u * (se - sw) + v * (nw - sw)
                      : ne + (1.0 - u) * (nw - ne) + (1.0 - v) * (se - ne);
}

Terrain::Terrain(const TangentFrame& frame, const HeightSource& source, const PostRect& posts)
    : frame_(frame),
      spacing_m_(source.spacing_m()),
      posts_(posts),
      heights_(static_cast<std::size_t>(posts.columns) * static_cast<std::size_t>(posts.rows)),
      z_(heights_.size()) {
  assert(posts.stride == 1 && posts.columns > kPatchCells && posts.rows > kPatchCells);
  assert((posts.columns - 1) % kPatchCells == 0 && (posts.rows - 1) % kPatchCells == 0);
  source.posts(posts, heights_);
  tbb::parallel_for(0, posts.rows, [&](int row) {
    for (int column = 0; column < posts_.columns; ++column) {
      const double z = frame_.z_at(x_m(column), y_m(row), static_cast<double>(heights_[index(column, row)]));
      z_[index(column, row)] = static_cast<float>(std::round(z * kStepsAMetre) / kStepsAMetre);
    }
  });
  patches_.resize(static_cast<std::size_t>(patches_east()) * static_cast<std::size_t>(patches_north()));
  tbb::parallel_for(std::size_t{0}, patches_.size(), [&](std::size_t k) {
    const auto east = static_cast<std::size_t>(patches_east());
    patches_[k] = summary_of(*this, static_cast<int>(k % east), static_cast<int>(k / east));
  });
}

double Terrain::height_above(const dvec3& position) const {
  const dvec3 local = frame_.local_from_ecef(position);
  return local.z - z_at(local.x, local.y);
}

bool Terrain::covers(double x_m, double y_m) const {
  const double i = x_m / spacing_m_ - static_cast<double>(posts_.i0);
  const double j = y_m / spacing_m_ - static_cast<double>(posts_.j0);
  return i >= 0.0 && j >= 0.0 && i <= posts_.columns - 1 && j <= posts_.rows - 1;
}

double Terrain::z_at(double x_m, double y_m) const {
  const double x = std::clamp(x_m / spacing_m_ - static_cast<double>(posts_.i0), 0.0, posts_.columns - 1.0);
  const double y = std::clamp(y_m / spacing_m_ - static_cast<double>(posts_.j0), 0.0, posts_.rows - 1.0);
  const int i = std::min(static_cast<int>(x), posts_.columns - 2);
  const int j = std::min(static_cast<int>(y), posts_.rows - 2);
  const auto at = [&](int di, int dj) { return static_cast<double>(z(i + di, j + dj)); };
  return in_cell({at(0, 0), at(1, 0), at(0, 1), at(1, 1)}, splits_north_east(i, j), x - i, y - j);
}

}  // namespace globe::flat
