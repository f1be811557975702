#pragma once

#include <vector>

#include "globe/planet/subdivision.h"

namespace globe::planet {

/// Geodetic normals of the nodes of a tile and `guard` nodes beyond: node_direction's bits at a twentieth of
/// its cost, beyond the diamond's edges at its full cost.
TileValues<dvec3> node_directions(const TileId& id, int guard = kTileGuard);

/// The same for a rectangle of a diamond's own nodes, first and last included: row by row, i fastest.
std::vector<dvec3> node_directions(int d, int level, const ivec2& first, const ivec2& last);

}  // namespace globe::planet
