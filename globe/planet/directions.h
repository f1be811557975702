#pragma once

#include "globe/planet/subdivision.h"

namespace globe::planet {

/// Geodetic normals of the nodes of a tile and `guard` nodes beyond: node_direction's bits at a twentieth of
/// its cost, beyond the diamond's edges at its full cost.
TileValues<dvec3> node_directions(const TileId& id, int guard = kTileGuard);

}  // namespace globe::planet
