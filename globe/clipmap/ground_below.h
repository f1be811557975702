#pragma once

#include "globe/clipmap/nadir.h"
#include "globe/clipmap/settings.h"
#include "globe/planet/surface.h"

namespace globe::clipmap {

/// A camera counts as no nearer to the ground than this, metres: 0.1, less on small bodies.
double least_above_ground(const geo::Ellipsoid& ellipsoid);

/// Height of a camera above the ground that is drawn at the finest level under it, metres.
///
/// @param position   ECEF metres
/// @param max_level  finest level of triangles
/// @param wait  true: of the level it wants, which may have to be synthesised first; false: of what is at
/// hand
double height_above_ground(const Settings& settings, const planet::Surface& surface, const dvec3& position,
                           int max_level, bool wait);

}  // namespace globe::clipmap
