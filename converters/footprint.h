#pragma once

#include <array>
#include <vector>

#include "converters/map_geometry.h"
#include "globe/planet/grid.h"

namespace converters {

/// The part of a map that belongs to one node: the cell whose corners are the centres of the trixels around
/// it, with sides straight in the map. The cells of a level tile the whole planet; the two pole cells are
/// caps.
struct Footprint {
  struct Corner {
    double x;  ///< columns from the node's own SamplePlace::x.whole
    double y;
  };
  std::array<Corner, 6> corner;
  int count = 0;

  double min_x() const;
  double max_x() const;
  double min_y() const;
  double max_y() const;
};

/// Footprint of a node that is not a pole. Depends on the vertex alone, not on the diamond that names it.
Footprint footprint_of(const MapGeometry& geometry, const globe::planet::Node& node);

/// Footprint from the place of the node and the centres of its trixels in order around it.
Footprint make_footprint(const MapGeometry& geometry, const SamplePlace& node,
                         const std::array<globe::planet::dvec3, 6>& centres, int count);

/// Direction of the middle of a trixel.
globe::planet::dvec3 trixel_centre(const globe::planet::dvec3& a, const globe::planet::dvec3& b,
                                   const globe::planet::dvec3& c);

/// The row coordinate where the cap of a pole's node ends.
double cap_rim(const MapGeometry& geometry, int level, bool north);

/// Lines of constant latitude along which footprints are integrated: every row is cut into `per_row` bands,
/// the same for all nodes, so that neighbours share the planet without gap or overlap.
class Scanlines {
 public:
  /// Enough lines that the cell of a node of `level` holds several.
  Scanlines(const MapGeometry& geometry, int level);

  /// First line at or below row coordinate y.
  int first_from(double y) const;
  int count() const { return static_cast<int>(weights_.size()); }
  double y(int line) const { return (line + 0.5) / per_row_ - 0.5; }
  /// Area of the line's band for one unit of longitude, up to a constant factor.
  double weight(int line) const { return weights_[static_cast<std::size_t>(line)]; }

 private:
  int per_row_;
  std::vector<double> weights_;
};

}  // namespace converters
