#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "flat/fractal/settings.h"
#include "flat/height_source.h"

namespace globe::flat::fractal {

/// 2^-h from square roots and products alone, each of which IEEE rounds one way only: the same bits on every
/// machine, which std::exp2 does not promise. Within 1e-15. REQUIRES: 0 <= h <= 1
double power_of_half(double h);

/// The subdivision itself. Depth 0 are the areas' corners, depth d the posts after d iterations; post (i, j)
/// of depth d lies at (i, j) times area_m / 2^d, and its height is a pure function of (settings, d, i, j): no
/// neighbour has to have been made, no order be kept.
///
/// What a rectangle of posts depends on is exactly `parents(rect)` one depth up: half as many posts, and at
/// either side the one post beyond, however many depths one goes (a cone that does not widen). So a block
/// with 2^n cells a side depends on 4x4 posts n depths up, and a single post on at most 4x4 at every depth.
///
/// With kSquareSquare posts lie between the coarser ones, not on them; (i - 1/2) times the step is then the
/// same place at every depth, and post (i, j) is shown at (i, j), so the ground is half a post off.
///
/// Heights are floats; every operation is one that IEEE rounds one way (build with -ffp-contract=off).
class Ground {
 public:
  /// Throws what check throws.
  explicit Ground(const Settings& settings);

  const Settings& settings() const { return settings_; }

  /// Deviation of what iteration `depth` adds (depth 0: of the areas' corners), metres.
  float deviation_m(int depth) const { return deviations_[static_cast<std::size_t>(depth)]; }
  /// No height is farther than this from base_m.
  double largest_m() const;

  /// The posts of depth - 1 that a rectangle of posts of `depth` is made from. REQUIRES: rect.stride == 1
  PostRect parents(const PostRect& rect) const;

  /// Room for work in progress; keep one a thread to allocate nothing after the first call.
  struct Workspace {
    std::array<std::vector<float>, 2> posts;
    std::array<std::vector<float>, 2> middles;
  };

  /// Posts of a depth, row by row from the south. REQUIRES: 0 <= depth <= iterations, rect.stride == 1,
  /// out.size() == columns * rows
  void heights(int depth, const PostRect& rect, std::span<float> out, Workspace& workspace) const;

  /// The same from posts that are there already. REQUIRES: known_depth <= depth; `known` holds what `parents`
  /// gives for rect when taken depth - known_depth times
  void heights_from(int known_depth, const PostRect& known, std::span<const float> known_heights, int depth,
                    const PostRect& rect, std::span<float> out, Workspace& workspace) const;

 private:
  float moved(float height, float deviation, std::uint64_t hash) const;
  void roots(const PostRect& rect, std::span<float> out) const;
  void refine(int depth, const PostRect& coarse, std::span<const float> coarse_heights, const PostRect& rect,
              std::span<float> out, Workspace& workspace) const;
  void refine_diamonds(int depth, const PostRect& coarse, std::span<const float> coarse_heights,
                       const PostRect& rect, std::span<float> out, Workspace& workspace) const;
  void refine_squares(int depth, const PostRect& coarse, std::span<const float> coarse_heights,
                      const PostRect& rect, std::span<float> out) const;

  Settings settings_;
  std::vector<float> deviations_;
  float base_ = 0.0f, contrast_ = 0.0f, per_relief_ = 0.0f;
};

/// The ground as a source of heights at its finest depth, for any renderer of flat/.
class FractalSource final : public HeightSource {
 public:
  explicit FractalSource(const Settings& settings) : ground_(settings) {}

  const Ground& ground() const { return ground_; }

  double spacing_m() const override { return ground_.settings().spacing_m(); }
  std::optional<PostRect> extent() const override { return std::nullopt; }
  void posts(const PostRect& rect, std::span<float> heights_m) const override;

 private:
  Ground ground_;
};

}  // namespace globe::flat::fractal
