#include <iostream>
#include <vector>

#include "globe/htm/cover.h"
#include "globe/planet/surface.h"
#include "globe/planet/trixels.h"
#include "globe/region/ellipsoid_cone.h"

int main() {
  // The trixels of many places, on all cores.
  const std::vector<double> lat{48.2082, -33.8688, 27.9881}, lon{16.3738, 151.2093, 86.925};
  std::vector<globe::htm::Trixel> trixels(lat.size());
  globe::planet::trixels_from_degrees(lat, lon, 20, trixels);
  for (const globe::htm::Trixel trixel : trixels) std::cout << globe::htm::name(trixel) << '\n';

  // What lies within 50 km of the first as ranges of ids: WHERE id BETWEEN first AND last.
  const globe::region::EllipsoidCone near(globe::geo::kWgs84, {lat[0], lon[0], 0}, 50e3);
  for (const globe::htm::IdRange& range : globe::htm::cover(near, {.level = 14, .max_ranges = 6}))
    std::cout << range.first << " to " << range.last << '\n';

  // Height of the built-in planet there; Surface::from_dataset opens one made by globe convert.
  const auto planet = globe::planet::Surface::builtin(1);
  const auto vienna = globe::geo::normal_from_degrees(lat[0], lon[0]);
  std::cout << planet->height(vienna, planet->data_level()) << " m above the ellipsoid, "
            << (near.contains(vienna) ? "within" : "beyond") << " 50 km\n";
}
