#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "flat/height_source.h"
#include "flat/tangent_frame.h"

namespace globe::flat {

/// Heights that are held.
class HeightGrid : public HeightSource {
 public:
  /// @param heights_m  of the posts of `extent` (stride 1), as HeightSource::posts gives them
  HeightGrid(double spacing_m, const PostRect& extent, std::vector<float> heights_m);

  double spacing_m() const override { return spacing_m_; }
  std::optional<PostRect> extent() const override { return extent_; }
  void posts(const PostRect& rect, std::span<float> heights_m) const override;

 private:
  double spacing_m_;
  PostRect extent_;
  std::vector<float> heights_m_;
};

/// Heights of some ground, metres above the ellipsoid and finite, under geodetic normals (ECEF, unit). Called
/// from any thread.
using GroundHeights = std::function<void(std::span<const dvec3> normals, std::span<float> heights_m)>;

/// The ground at the posts of a rectangle (stride 1), on all threads.
///
/// A post's vertical is that of the frame, tilted from the ground's own by up to a degree: what stands over
/// it is found by going back and forth between place and height until the height moves by less than
/// `close_m`, five times at most. `progress` hears of the share done.
HeightGrid sample_ground(const TangentFrame& frame, double spacing_m, const PostRect& rect,
                         const GroundHeights& ground, double close_m = 0.005,
                         const std::function<void(double)>& progress = {});

}  // namespace globe::flat
