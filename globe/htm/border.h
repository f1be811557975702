#pragma once

#include <memory>
#include <vector>

#include "globe/htm/box_tree.h"
#include "globe/htm/trixel.h"

namespace globe::htm {

/// A smooth curve on the sphere that is no great circle: a parallel, a straight line of a map, a geodesic
/// circle of an ellipsoid.
class Curve {
 public:
  virtual ~Curve() = default;

  /// Its point (unit) at a parameter in [0, 1].
  virtual dvec3 at(double t) const = 0;

  /// A bound of |d²u/dt²| for t in [t0, t1]. A piece strays from its chord by an eighth of that, times (t1 -
  /// t0)², at most.
  virtual double bend(double t0, double t1) const = 0;
};

/// Curves that bound a region, in a tree of pieces.
///
/// A trixel is tested against a piece as if it were its chord, with the stray as thickness; pieces for which
/// that does not decide are halved, until the stray is below the rounding of a direction.
class Border {
 public:
  /// @param margin  radians by which the border is thickened, for what the region's `contains` leaves open
  Border(std::vector<std::shared_ptr<const Curve>> curves, double margin);

  /// False when no point of the border is in the trixel, for certain; true when one is, or comes within the
  /// margin and 3e-15 rad of it.
  bool touches(const Corners& trixel) const;

 private:
  struct Piece {
    const Curve* curve = nullptr;
    double t0 = 0, t1 = 0;
    dvec3 p{0.0}, q{0.0};  ///< its ends
  };
  struct Sides;

  double stray(const Piece& piece) const;
  void add_pieces(const Piece& piece, std::vector<Box>& boxes);
  bool touches(const Piece& piece, const Corners& trixel, const Sides& sides) const;

  std::vector<std::shared_ptr<const Curve>> curves_;
  double margin_;
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

}  // namespace globe::htm
