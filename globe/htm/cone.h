#pragma once

#include "globe/htm/region.h"

namespace globe::htm {

/// All directions within an angle of a direction: a cone around it, or the cap that it cuts out of the
/// sphere.
///
/// Angles are compared as squared chords, never by acos, and beyond 90 degrees from the opposite end, so that
/// cones of a millimetre and those of 180 degrees less a millimetre are as sharp as any other.
/// `contains` takes in what lies within 2e-15 rad (13 nm on the Earth) of the border, more than the rounding
/// of a direction; `relation` says kTouches within another 2e-15 rad.
class Cone final : public Region {
 public:
  /// @param center  unit
  /// @param radius_deg  0..180; 0 is the point alone, 180 the whole sphere. Throws UsageError outside.
  Cone(const dvec3& center, double radius_deg);

  bool contains(const dvec3& u) const override;
  Relation relation(const Corners& trixel) const override;
  std::vector<dvec3> border_points() const override;

  const dvec3& center() const { return center_; }
  double radius_deg() const { return radius_deg_; }

 private:
  Relation cap_relation(const Corners& trixel) const;

  dvec3 center_;
  double radius_deg_;
  bool outside_;           ///< the region is what lies outside the cap: the cone is wider than 90 degrees
  bool everything_;        ///< not even the opposite point is left out
  dvec3 pole_;             ///< of the cap, whose radius is at most 90 degrees
  double contains2_;       ///< squared chord up to which (from which, if outside_) a direction is contained
  double certain2_;        ///< squared chord up to which a corner counts as in the cap for certain
  double possible2_;       ///< squared chord up to which it may be in the cap
  double possible_sine2_;  ///< squared sine of that angle
};

}  // namespace globe::htm
