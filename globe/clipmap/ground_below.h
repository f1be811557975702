#pragma once

#include "globe/clipmap/nadir.h"
#include "globe/clipmap/settings.h"
#include "globe/planet/surface.h"

namespace globe::clipmap {

/// A camera counts as no nearer to the ground than this, metres: 0.1, less on small bodies.
double least_above_ground(const geo::Ellipsoid& ellipsoid);

/// Height of a camera above the ground that is drawn at the finest level under it, metres; over a sea above
/// its level, below that, where its floor is bare, above the floor.
///
/// @param position   ECEF metres
/// @param max_level  finest level of triangles
/// @param wait  true: of the level it wants, which may have to be synthesised first; false: of what is at
/// hand
double height_above_ground(const Settings& settings, const planet::Surface& surface, const dvec3& position,
                           int max_level, bool wait);

/// How near a camera is to what is drawn under or over it, metres, which its detail goes by: its height above
/// ground, under water no more than its depth; at least least_above_ground.
double nearest_drawn(const planet::Surface& surface, const dvec3& position, double above_ground_m);

}  // namespace globe::clipmap
