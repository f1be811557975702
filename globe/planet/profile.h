#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "globe/planet/interpolation.h"
#include "globe/planet/surface.h"

namespace globe::planet {

/// The ground at a place on the way from A to B.
struct ProfileSample {
  double distance_m = 0;  ///< from A, along the geodesic
  geo::Geodetic place;    ///< latitude and longitude; h_m is 0
  double height_m = 0;    ///< of the ground, above the planet's vertical datum
};

/// Samples at equal distances along the geodesic of the planet's ellipsoid, the first and the last exactly at
/// a and b. Which geodesic, where several are shortest: geo/geodesic.h. REQUIRES: count >= 2.
/// @param level  of the ground; none: the data at their finest, wherever that is (data_height_at)
std::vector<ProfileSample> profile(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b,
                                   std::size_t count, std::optional<int> level, Interpolation interpolation);

/// The coarsest and the finest level of the data along a geodesic, by 1024 places of it.
struct DataLevels {
  int coarsest = 0, finest = 0;
};
DataLevels data_levels_along(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b);

/// How many samples show all that a level has: two a grid edge, 512 at least and 65536 at most; 2 where A is
/// B.
std::size_t profile_count(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b, int level);

}  // namespace globe::planet
