#include "app/accuracy/harmonic_planet.h"

#include "converters/node_planet.h"
#include "globe/geo/ellipsoid.h"
#include "globe/planet/grid.h"

namespace app::accuracy {

namespace planet = globe::planet;

HarmonicPlanet::HarmonicPlanet(const converters::Harmonics& harmonics, int level)
    : folder_("globe-accuracy") {
  converters::write_node_planet(folder_.path(), level, globe::geo::kWgs84, [&](const planet::Node& node) {
    // By the node's own name, so that diamonds agree on what they share.
    const globe::geo::Geodetic place =
        globe::geo::degrees_from_normal(planet::node_direction(planet::fold(node)));
    return harmonics.at(place.lat_deg, place.lon_deg);
  });
  surface_ = planet::Surface::from_dataset(
      std::make_shared<const planet::Dataset>(planet::Dataset::open(folder_.path(), std::size_t{64} << 20)));
}

}  // namespace app::accuracy
