#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace globe::flat {

/// Posts of a regular grid: columns i0, i0 + stride, ... (eastward) of rows j0, j0 + stride, ... (northward).
struct PostRect {
  std::int64_t i0 = 0;
  std::int64_t j0 = 0;
  int columns = 0;
  int rows = 0;
  int stride = 1;

  friend bool operator==(const PostRect&, const PostRect&) = default;
};

/// Heights on a regular grid in the plane of a tangent frame (tangent_frame.h): post (i, j) lies i spacings
/// east and j spacings north of the frame's origin, either of which may be negative.
///
/// A height is a function of the post alone, the same whichever rectangle it is asked in, in any order and
/// from any thread.
class HeightSource {
 public:
  HeightSource() = default;
  HeightSource(const HeightSource&) = delete;
  HeightSource& operator=(const HeightSource&) = delete;
  virtual ~HeightSource() = default;

  /// Metres between neighbouring posts, > 0.
  virtual double spacing_m() const = 0;
  /// The posts there are, at stride 1; nothing for ground without end.
  virtual std::optional<PostRect> extent() const = 0;
  /// Heights of posts, metres above the ellipsoid, all finite; row by row from the south, each from the west.
  /// REQUIRES: rect within extent(), stride >= 1, heights_m.size() == columns * rows.
  virtual void posts(const PostRect& rect, std::span<float> heights_m) const = 0;
};

/// Height at a place of the plane (metres east and north), bilinear between the four posts around it; outside
/// the extent that of the nearest place within.
double height_m(const HeightSource& source, double x_m, double y_m);

}  // namespace globe::flat
