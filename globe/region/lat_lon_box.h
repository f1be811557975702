#pragma once

#include "globe/htm/border.h"
#include "globe/htm/region.h"

namespace globe::region {

/// Between two meridians and two parallels, all of them inside: lines of a map, not great circles.
///
/// From west eastward to east, so that a box with west > east runs across longitude 180. A width of 360
/// degrees or more is the whole band, which has no meridian for a border; a box that reaches a pole holds it.
class LatLonBox final : public htm::Region {
 public:
  /// Degrees. Throws UsageError: south > north, a latitude beyond 90, what is not finite.
  LatLonBox(double west_deg, double south_deg, double east_deg, double north_deg);

  bool contains(const htm::dvec3& u) const override;
  htm::Relation relation(const htm::Corners& trixel) const override;
  std::vector<htm::dvec3> border_points() const override;

 private:
  double west_deg_, south_deg_, width_deg_, north_deg_;
  htm::Border border_;
};

}  // namespace globe::region
