#include "app/standing_camera.h"

#include <cstdio>

namespace app {
namespace {

constexpr double kLeastHeight = 2.0;  ///< metres above ground

}  // namespace

globe::geo::Geodetic standing_place(const Point& at, bool agl, const globe::geo::Ellipsoid& ellipsoid,
                                    const std::function<double(const glm::dvec3&)>& height_above_ground) {
  globe::geo::Geodetic place = at.position;
  const double given = place.h_m;
  const auto above = [&] { return height_above_ground(globe::geo::ecef_from_geodetic(ellipsoid, place)); };
  if (agl) place.h_m += given - above();
  const double low = above();
  if (low >= kLeastHeight) return place;
  if (!agl || given < kLeastHeight) {
    std::fprintf(stderr, "globe: warning: the camera is %.1f m below %.0f m above ground; raised\n",
                 kLeastHeight - low, kLeastHeight);
  }
  place.h_m += kLeastHeight - low;
  return place;
}

}  // namespace app
