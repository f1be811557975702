#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "flat/height_source.h"
#include "flat/tangent_frame.h"

namespace globe::flat {

/// A patch is a square of 16 cells a side, 17 x 17 posts; neighbours share their borders (Wagner).
inline constexpr int kPatchCells = 16;
/// Level 0 draws every post of a patch, level 4 its corners alone: 512, 128, 32, 8, 2 triangles.
inline constexpr int kLevels = 5;

/// Distances along z between the mesh of a level and that of level 0, metres; the array grows with the level.
using LevelErrors = std::array<float, kLevels>;

/// What is known of a patch as long as it is not drawn.
struct PatchSummary {
  float lowest_m = 0, highest_m = 0;  ///< z of its posts
  /// The largest of each quarter: south-west, south-east, north-west, north-east. Seen from near, one quarter
  /// counts for more than the others.
  std::array<LevelErrors, 4> errors_m{};
};

/// A rectangle of patches as it is drawn: posts of a regular grid in a tangent frame, each at the very place
/// that its height above the ellipsoid has there. Between posts the ground is made of flat triangles.
///
/// Cells of every level are split into two triangles along diagonals that alternate like a chess board's
/// squares: a cell whose column and row (counted in the patch) add up to an even number from south-west to
/// north-east, else from south-east to north-west. So the triangles of a coarser level are unions of finer
/// ones, and a border's odd vertex can go with no other vertex moving.
class Terrain {
 public:
  /// The posts of `source` within `posts`, whose columns and rows are whole patches and one post more.
  /// REQUIRES: stride 1, at least one patch.
  Terrain(const TangentFrame& frame, const HeightSource& source, const PostRect& posts);

  const TangentFrame& frame() const { return frame_; }
  double spacing_m() const { return spacing_m_; }
  const PostRect& posts() const { return posts_; }
  int patches_east() const { return (posts_.columns - 1) / kPatchCells; }
  int patches_north() const { return (posts_.rows - 1) / kPatchCells; }
  std::size_t patch_count() const { return patches_.size(); }
  /// Patches are numbered from the south-west, row by row.
  const PatchSummary& patch(std::size_t index) const { return patches_[index]; }

  /// z of a post, metres, whole multiples of 1/1024; columns and rows count from the south-west.
  float z(int column, int row) const { return z_[index(column, row)]; }
  std::span<const float> z() const { return z_; }
  /// Height above the ellipsoid, metres.
  float height(int column, int row) const { return heights_[index(column, row)]; }
  /// Place of a post in the plane of the frame.
  double x_m(int column) const { return static_cast<double>(posts_.i0 + column) * spacing_m_; }
  double y_m(int row) const { return static_cast<double>(posts_.j0 + row) * spacing_m_; }

  /// z over a place of the plane on the mesh of level 0; outside the region that of the nearest place within.
  double z_at(double x_m, double y_m) const;
  /// Whether the region lies under it.
  bool covers(double x_m, double y_m) const;
  /// Height of a place over that mesh along the frame's vertical, metres.
  /// @param position  ECEF
  double height_above(const dvec3& position) const;

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(posts_.columns) +
           static_cast<std::size_t>(column);
  }

  TangentFrame frame_;
  double spacing_m_;
  PostRect posts_;
  std::vector<float> heights_, z_;
  std::vector<PatchSummary> patches_;
};

/// Whether a cell of a level, column and row counted in its patch, is split from south-west to north-east.
constexpr bool splits_north_east(int column, int row) { return (column + row) % 2 == 0; }

/// Value inside a cell, 0 <= u, v <= 1 from its south-west corner, linear in the two triangles. `corners`:
/// south-west, south-east, north-west, north-east.
double in_cell(const std::array<double, 4>& corners, bool north_east, double u, double v);

}  // namespace globe::flat
