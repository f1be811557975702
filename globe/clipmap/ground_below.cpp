#include "globe/clipmap/ground_below.h"

#include <algorithm>

#include "globe/clipmap/morph.h"

namespace globe::clipmap {
namespace {

double nearest(const planet::Surface& surface, double height_m, double above_ground_m) {
  return surface.has_bare_floor() && height_m < 0.0 ? std::min(above_ground_m, -height_m) : above_ground_m;
}

}  // namespace

double least_above_ground(const geo::Ellipsoid& ellipsoid) { return 0.1 * geo::small_body_scale(ellipsoid); }

double height_above_ground(const Settings& settings, const planet::Surface& surface, const dvec3& position,
                           int max_level, bool wait) {
  const geo::Geodetic place = geo::geodetic_from_ecef(surface.ellipsoid(), position);
  const dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const auto drawn = [&](int level) {
    const double h = wait ? surface.height(u, level) : surface.height_at_hand(u, level);
    return place.h_m - (place.h_m < 0.0 ? surface.mesh_height(h) : surface.drawn_height(h));
  };
  const double least = 5.0 * least_above_ground(surface.ellipsoid());
  double above = drawn(settings.base_level);
  for (int k = 0; k < 3; ++k)
    above = drawn(finest_level(settings, surface.root_edge(),
                               std::max(nearest(surface, place.h_m, above), least), max_level)
                      .level);
  return above;
}

double nearest_drawn(const planet::Surface& surface, const dvec3& position, double above_ground_m) {
  const double height_m = geo::geodetic_from_ecef(surface.ellipsoid(), position).h_m;
  return std::max(nearest(surface, height_m, above_ground_m), least_above_ground(surface.ellipsoid()));
}

}  // namespace globe::clipmap
