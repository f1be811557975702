#pragma once

#include "globe/geo/ellipsoid.h"
#include "globe/htm/border.h"
#include "globe/htm/region.h"

namespace globe::region {

/// All places within a geodesic distance of a place on an ellipsoid, as a region of their normals.
///
/// The border is the geodesic circle itself (geo/geodesic_circle.h), so covers are as tight as those of a
/// cone on the sphere. Distances of the points asked for are GeographicLib's. `contains` takes in what lies
/// within 5e-15 of the equatorial radius (32 nm on the Earth) beyond; `relation` says kTouches within 2e-14.
/// Beyond the distance at which geodesics may cease to be shortest (19,970 km on the Earth, 34 km before the
/// antipode) circles are not borders: there trixels are judged by the distance of their centre and their
/// size, which makes covers looser by about one trixel of the level.
class EllipsoidCone final : public htm::Region {
 public:
  /// @param radius_m  at least 0; beyond the longest distance on the ellipsoid all is inside
  EllipsoidCone(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& center, double radius_m);

  bool contains(const htm::dvec3& u) const override;
  htm::Relation relation(const htm::Corners& trixel) const override;
  std::vector<htm::dvec3> border_points() const override;

 private:
  double distance_m(const htm::dvec3& u) const;

  geo::Ellipsoid ellipsoid_;
  geo::Geodetic center_;
  htm::dvec3 center_normal_;
  double radius_m_;
  double shortest_scale_m_,
      longest_scale_m_;  ///< metres on the ellipsoid a radian between normals, at least, at most
  bool everything_;
  bool circle_is_border_;
  htm::Border border_;
};

}  // namespace globe::region
