#include "globe/clipmap/ground_below.h"

#include <algorithm>

#include "globe/clipmap/morph.h"

namespace globe::clipmap {

double least_above_ground(const geo::Ellipsoid& ellipsoid) { return 0.1 * geo::small_body_scale(ellipsoid); }

double height_above_ground(const Settings& settings, const planet::Surface& surface, const dvec3& position,
                           int max_level, bool wait) {
  const geo::Geodetic place = geo::geodetic_from_ecef(surface.ellipsoid(), position);
  const dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const auto drawn = [&](int level) {
    const double h = wait ? surface.height(u, level) : surface.height_at_hand(u, level);
    return place.h_m - surface.drawn_height(h);
  };
  const double least = 5.0 * least_above_ground(surface.ellipsoid());
  double above = drawn(settings.base_level);
  for (int k = 0; k < 3; ++k)
    above = drawn(finest_level(settings, surface.root_edge(), std::max(above, least), max_level).level);
  return above;
}

}  // namespace globe::clipmap
