#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

namespace globe::flat::fractal {

/// a x + b y + c z + d, positive outside: the normal (a, b, c) points out of the view.
template <class Real>
struct Plane {
  Real a, b, c, d;
};

/// A box along the axes.
template <class Real>
struct Box {
  std::array<Real, 3> low, high;
};

enum class Side { kOutside, kCut, kInside };

/// Where a box lies by a plane, from two of its corners: n, the nearest along the normal, and p, the
/// farthest, which three signs pick. n outside: all of it is; p inside: all of it is. 6 multiplications, 6
/// additions, 5 comparisons (all eight corners: 24 and 24). Source: Assarsson and Moeller 2000; the table in
/// Christopoulos 4.3, whose normals point out as here.
template <class Real>
Side side_of(const Plane<Real>& plane, const Box<Real>& box) {
  const Real zero{};
  const bool x = plane.a > zero, y = plane.b > zero, z = plane.c > zero;
  const Real near = plane.a * (x ? box.low : box.high)[0] + plane.b * (y ? box.low : box.high)[1] +
                    plane.c * (z ? box.low : box.high)[2] + plane.d;
  if (near > zero) return Side::kOutside;
  const Real far = plane.a * (x ? box.high : box.low)[0] + plane.b * (y ? box.high : box.low)[1] +
                   plane.c * (z ? box.high : box.low)[2] + plane.d;
  return far > zero ? Side::kCut : Side::kInside;
}

/// The five planes of a view whose far plane is at infinity: left, right, bottom, top and the plane through
/// the eye across its axis. In the space that the matrix takes to clip space.
using View = std::array<Plane<double>, 5>;
View view_of(const glm::dmat4& clip_from_space);

/// Lowest and highest ground of the blocks of a square, and of each four of them, and so on to the whole: a
/// complete quad tree in an array, the children of node k at 4k + 1 to 4k + 4.
class HeightTree {
 public:
  /// Blocks along a side: 2^log2_side.
  explicit HeightTree(int log2_side);

  int side() const { return 1 << log2_side_; }

  struct Range {
    float low, high;
  };
  /// @param range_of  the heights of block (column, row)
  template <class RangeOf>
  void update(const RangeOf& range_of) {
    fill(0, 0, 0, side(), range_of);
  }

  struct Counts {
    std::uint64_t boxes = 0;   ///< asked about
    std::uint64_t planes = 0;  ///< of them, one by one
  };

  /// The blocks that a view may see, as row * side + column, into `visible`, nearest first. Boxes outside one
  /// plane take all below with them; planes that a box is wholly inside of are not asked again below it.
  /// @param origin  the square's south-western corner at height 0, in the view's space; the eye is at 0
  /// @param block   a block's side in the same unit
  Counts visible(const View& view, const std::array<double, 3>& origin, double block,
                 std::vector<int>& visible) const;

 private:
  template <class RangeOf>
  Range fill(std::size_t node, int column, int row, int size, const RangeOf& range_of) {
    Range& range = nodes_[node];
    if (size == 1) return range = range_of(column, row);
    const int half = size / 2;
    range = fill(4 * node + 1, column, row, half, range_of);
    for (int k = 1; k < 4; ++k) {
      const Range part = fill(4 * node + 1 + static_cast<std::size_t>(k), column + half * (k & 1),
                              row + half * (k >> 1), half, range_of);
      range = {part.low < range.low ? part.low : range.low, part.high > range.high ? part.high : range.high};
    }
    return range;
  }

  struct Query;
  void descend(Query& query, std::size_t node, int column, int row, int size, unsigned planes) const;

  int log2_side_;
  std::vector<Range> nodes_;
};

}  // namespace globe::flat::fractal
