#pragma once

#include "globe/htm/border.h"

namespace globe::region {

/// A place on a map: degrees, the longitude not folded.
struct MapPoint {
  double lat_deg = 0, lon_deg = 0;

  friend bool operator==(const MapPoint&, const MapPoint&) = default;
};

inline constexpr double kTurn = 360.0;  ///< degrees

/// A straight line in latitude and longitude: lat and lon are linear in t (RFC 7946, 3.1.1). A parallel and a
/// meridian are special cases; at a pole it stands still.
class MapLine final : public htm::Curve {
 public:
  MapLine(const MapPoint& from, const MapPoint& to) : from_(from), to_(to) {}

  htm::dvec3 at(double t) const override;
  double bend(double t0, double t1) const override;

 private:
  double latitude_deg(double t) const;

  MapPoint from_, to_;
};

/// Half the width of the border that the regions made of map lines count as inside, degrees: 1e-13, 11 nm on
/// the Earth, more than the rounding of a direction and back to degrees.
inline constexpr double kMapBorderDeg = 1e-13;
/// And the margin in radians for htm::Border, somewhat wider.
inline constexpr double kMapBorderMargin = 5e-15;

}  // namespace globe::region
