#pragma once

#include <cstdint>

#include "globe/planet/surface.h"

namespace globe::planet {

/// Ground below the finest data. Every function is pointwise: what it writes at a node depends on the seed,
/// the node's key, the level and the predicted values there, so that every tile that holds a node computes
/// the same bits.
///
/// A tile comes in with all values predicted from its parent. `root_edge` is the length of a level-0 edge in
/// metres. With `own_nodes_only` the guard is left alone.

/// The built-in planet at any level: continents and mountain chains down to some 20 km, detail below.
void synthesise_builtin(std::uint64_t seed, double root_edge, bool own_nodes_only, SurfaceTile& tile);

/// Detail `depth` (1, 2, ...) levels below the finest data.
void synthesise_detail(std::uint64_t seed, double root_edge, int depth, bool own_nodes_only,
                       SurfaceTile& tile);

/// Roughness of measured ground from the slopes between neighbouring nodes, for the tile at the data's finest
/// level.
void measure_roughness(double root_edge, SurfaceTile& tile);

}  // namespace globe::planet
