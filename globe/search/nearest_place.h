#pragma once

#include <GeographicLib/Geodesic.hpp>
#include <limits>

#include "globe/geo/ellipsoid.h"

namespace globe::search {

/// The place of something that is nearest to another place.
struct Nearest {
  geo::Geodetic at;
  double distance_m = std::numeric_limits<double>::infinity();
};

/// Measures from one place, and keeps the nearest of what it has seen.
///
/// Distances are geodesics on the ellipsoid (GeographicLib, 15 nm on the Earth).
class NearestPlace {
 public:
  NearestPlace(const GeographicLib::Geodesic& earth, const geo::Geodetic& from);

  /// @param u  its normal
  void look_at_point(const geo::Geodetic& at, const geo::dvec3& u);

  /// The great circle of normals from a to b (unit, less than 180 degrees apart), its ends excepted: these
  /// are points, to be looked at before.
  ///
  /// It is cut into pieces of two degrees. On those that may hold a nearer place the derivative of the
  /// distance, which is the cosine between the geodesic and the edge, is brought to zero. The distance is
  /// then off by less than 30 nm. Within 50 km of the antipode of the place, where geodesics cross, it can be
  /// too long by up to the distance of the next piece's end.
  void look_at_edge(const geo::dvec3& a, const geo::dvec3& b);

  const Nearest& best() const { return best_; }

 private:
  struct Arc;

  /// How the distance changes along the arc, metres a radian, at x radians from its beginning.
  double slope(const Arc& arc, double x) const;
  /// Whether something at this angle between normals, or farther, can be nearer than the best.
  bool may_be_nearer(double angle) const;
  void look_at(const Arc& arc, double x);
  void look_between(const Arc& arc, double x0, double x1);

  const GeographicLib::Geodesic& earth_;
  geo::Ellipsoid ellipsoid_;
  geo::Geodetic from_;
  geo::dvec3 from_normal_;
  double shortest_scale_m_;  ///< metres on the ellipsoid a radian between normals, at least
  Nearest best_;
};

}  // namespace globe::search
