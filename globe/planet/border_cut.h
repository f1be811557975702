#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>

#include "globe/htm/region.h"
#include "globe/planet/lattice_trixel.h"

namespace globe::planet {

/// A trixel that the border of a region crosses, and a surface that is linear in it.
struct CutTrixel {
  htm::Corners corners;
  std::array<double, 3> heights;  ///< metres, at the corners

  double mean() const { return (heights[0] + heights[1] + heights[2]) / 3.0; }
  dvec3 center() const;
  /// The four trixels of the next level.
  std::array<CutTrixel, 4> parts() const;
};

/// A part of a trixel: its share of the area, and the mean height there.
struct Piece {
  double share = 0;
  double mean_m = 0;
};

/// Cuts trixels on the border of a region along the straight line between where it crosses two of their
/// sides. Remembers what it asked the region: corners and sides are shared.
class BorderCutter {
 public:
  explicit BorderCutter(const htm::Region& region) : region_(region) {}

  /// Whether a corner is in the region.
  bool inside(const dvec3& corner);

  /// The part of a trixel that is in the region, by its corners and the crossings of its sides; the crossings
  /// are right to 2^-halvings of the side. A border that crosses no side of it, or one side twice, goes
  /// unseen.
  Piece inner_piece(const CutTrixel& t, int halvings);

 private:
  struct Hash {
    std::size_t operator()(const dvec3& u) const;
  };

  /// How far along from a to b the border crosses, 0 to 1. REQUIRES: one of a and b is inside.
  double crossing(const dvec3& a, const dvec3& b, int halvings);

  const htm::Region& region_;
  std::unordered_map<dvec3, bool, Hash> inside_;
  std::unordered_map<dvec3, double, Hash> crossings_;  ///< from the end inside, by a sum of both ends
};

}  // namespace globe::planet
