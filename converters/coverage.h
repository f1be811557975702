#pragma once

#include <vector>

#include "converters/map_geometry.h"

namespace converters {

/// Share of the planet's sphere of normals, 0 to 1, on which none of the maps lies, counted at 20,000 places
/// spread evenly. Voids inside a map count as the map.
double uncovered_share(const std::vector<MapGeometry>& maps);

}  // namespace converters
