#include "globe/planet/profile.h"

#include <algorithm>
#include <cmath>

#include "globe/geo/geodesic.h"
#include "globe/planet/inset_stack.h"

namespace globe::planet {

std::vector<ProfileSample> profile(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b,
                                   std::size_t count, std::optional<int> level, Interpolation interpolation) {
  const geo::GeodesicSolver solver(surface.ellipsoid());
  const double length_m = solver.inverse(a, b).s12_m;
  std::vector<ProfileSample> samples;
  samples.reserve(count);
  for (const geo::Geodetic& place : solver.places_along(a, b, count)) {
    const double share = static_cast<double>(samples.size()) / static_cast<double>(count - 1);
    const dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
    const Height ground =
        level ? height_at(surface, u, *level, interpolation) : data_height_at(surface, u, interpolation);
    samples.push_back({share * length_m, place, ground.height_m});
  }
  return samples;
}

DataLevels data_levels_along(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b) {
  constexpr std::size_t kPlaces = 1024;
  DataLevels levels{surface.finest_data_level(), surface.data_level()};
  if (surface.insets().empty()) return levels;
  for (const geo::Geodetic& place : geo::GeodesicSolver(surface.ellipsoid()).places_along(a, b, kPlaces)) {
    const int level = surface.data_at(geo::normal_from_degrees(place.lat_deg, place.lon_deg)).level;
    levels.coarsest = std::min(levels.coarsest, level);
    levels.finest = std::max(levels.finest, level);
  }
  return levels;
}

std::size_t profile_count(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b, int level) {
  constexpr double kFewest = 512, kMost = 65536;
  const double length_m = geo::GeodesicSolver(surface.ellipsoid()).inverse(a, b).s12_m;
  if (length_m == 0.0) return 2;
  const double edge_m = std::ldexp(surface.root_edge(), -level);
  return static_cast<std::size_t>(std::clamp(std::ceil(2.0 * length_m / edge_m) + 1.0, kFewest, kMost));
}

}  // namespace globe::planet
