#pragma once

#include "globe/planet/subdivision.h"

namespace globe::planet {

/// Geodetic normals of all nodes of a tile and its guard: node_direction's bits, some 15 ns each.
TileValues<dvec3> node_directions(const TileId& id);

}  // namespace globe::planet
