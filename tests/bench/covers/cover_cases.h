#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace bench {

/// Where the cones and polygons of the cover benchmarks stand, and how large they are.
struct CoverPlace {
  double lat_deg, lon_deg, radius_deg;
  int level;  ///< whose trixels are about a tenth of the radius
};

/// Several places a size: ranges and waste depend on where the index' seams run.
inline std::vector<CoverPlace> cover_places(double radius_deg, int level) {
  return {{48.21, 16.37, radius_deg, level},   {-33.45, -70.67, radius_deg, level},
          {1.35, 103.82, radius_deg, level},   {71.29, -156.79, radius_deg, level},
          {-77.85, 166.67, radius_deg, level}, {27.99, 86.93, radius_deg, level},
          {40.71, -74.01, radius_deg, level},  {-1.29, 36.82, radius_deg, level}};
}

/// Twelve corners around the place, near and far in turn by a tenth.
inline std::vector<glm::dvec3> twelve_gon(const CoverPlace& place) {
  const glm::dvec3 center = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const globe::geo::LocalFrame frame = globe::geo::local_frame(place.lat_deg, place.lon_deg);
  std::vector<glm::dvec3> corners;
  for (int k = 0; k < 12; ++k) {
    const double azimuth = -2.0 * M_PI * k / 12.0;
    const double r = place.radius_deg * (k % 2 == 0 ? 1.0 : 0.9) * M_PI / 180.0;
    corners.push_back(glm::normalize(std::cos(r) * center + std::sin(r) * (std::sin(azimuth) * frame.east +
                                                                           std::cos(azimuth) * frame.north)));
  }
  return corners;
}

}  // namespace bench
