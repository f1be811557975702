#pragma once

#include <nlohmann/json.hpp>

#include "globe/htm/trixel.h"

namespace app {

/// A trixel's ring as the coordinates of a GeoJSON Polygon (RFC 7946): closed, counter-clockwise, longitude
/// first, in degrees.
///
/// Sides are great circles, drawn in steps of at most a degree. A trixel lies in one octant, between two
/// longitudes a quarter apart, so no ring crosses 180 degrees, and its longitudes are written on their own
/// side of it. At a pole the ring runs along latitude 90 from one side's longitude to the other's.
nlohmann::ordered_json trixel_coordinates(globe::htm::Trixel trixel);

}  // namespace app
