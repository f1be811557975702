#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "globe/geo/ellipsoid.h"

namespace globe::flat {

using glm::dmat3;
using glm::dvec3;

/// Cartesian coordinates of a region, metres: the origin on the ellipsoid, x east and y north in the plane
/// that touches it there, z up (GeographicLib::LocalCartesian). Curvature is not left out: sea level 80 km
/// east and north of the origin has z = -1003.
class TangentFrame {
 public:
  /// The origin, degrees.
  TangentFrame(const geo::Ellipsoid& ellipsoid, double lat_deg, double lon_deg);

  const geo::Ellipsoid& ellipsoid() const { return ellipsoid_; }
  /// Latitude, longitude in [-180, 180), height 0.
  const geo::Geodetic& origin() const { return origin_; }
  /// Columns: unit vectors east, north and up, ECEF.
  const dmat3& axes() const { return axes_; }

  dvec3 ecef_from_local(const dvec3& local) const { return center_ + axes_ * local; }
  dvec3 local_from_ecef(const dvec3& ecef) const { return (ecef - center_) * axes_; }
  geo::Geodetic geodetic_from_local(const dvec3& local) const;
  dvec3 local_from_geodetic(const geo::Geodetic& place) const;

  /// z of the point over (x, y) of the plane that lies h_m above the ellipsoid, to a micrometre.
  /// REQUIRES: (x, y) within half the radius of the origin.
  double z_at(double x_m, double y_m, double h_m) const;
  /// Geodetic normal of that point, ECEF.
  dvec3 normal_at(double x_m, double y_m, double h_m) const;

 private:
  geo::Ellipsoid ellipsoid_;
  geo::Geodetic origin_;
  GeographicLib::LocalCartesian cartesian_;
  dvec3 center_;
  dmat3 axes_;
};

}  // namespace globe::flat
