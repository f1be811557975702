#include "app/standing_camera.h"

#include <cstdio>

#include "app/flight.h"

namespace app {

globe::geo::Geodetic standing_place(const Point& at, bool agl, const globe::geo::Ellipsoid& ellipsoid,
                                    const std::function<double(const glm::dvec3&)>& height_above_ground) {
  globe::geo::Geodetic place = at.position;
  const double given = place.h_m;
  const auto above = [&] { return height_above_ground(globe::geo::ecef_from_geodetic(ellipsoid, place)); };
  if (agl) place.h_m += given - above();
  const double least = least_clearance(ellipsoid);
  const double low = above();
  if (low >= least) return place;
  if (!agl || given < least) {
    const char* text = least >= 1.0
                           ? "globe: warning: the camera is %.1f m below %.0f m above ground; raised\n"
                           : "globe: warning: the camera is %.3g m below %.3g m above ground; raised\n";
    std::fprintf(stderr, text, least - low, least);
  }
  place.h_m += least - low;
  return place;
}

}  // namespace app
