#include "converters/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace converters {

double uncovered_share(const std::vector<MapGeometry>& maps) {
  const auto whole = [](const MapGeometry& map) { return map.is_whole_planet(); };
  if (std::any_of(maps.begin(), maps.end(), whole)) return 0.0;
  constexpr int kPlaces = 20000;
  std::vector<globe::geo::dvec3> places;  // a spiral from pole to pole, each turn a golden angle
  for (int k = 0; k < kPlaces; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kPlaces, r = std::sqrt(1.0 - z * z);
    const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * k;
    places.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  std::vector<char> covered(places.size(), 0);
  std::vector<SamplePlace> found(places.size());
  for (const MapGeometry& map : maps) {
    find_places(map, places.data(), places.size(), 0.0, found.data());
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (is_on(map, found[k])) covered[k] = 1;
    }
  }
  return static_cast<double>(std::count(covered.begin(), covered.end(), 0)) / kPlaces;
}

}  // namespace converters
