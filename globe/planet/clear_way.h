#pragma once

#include <vector>

#include "globe/planet/surface.h"

namespace globe::planet {

/// How a camera keeps clear of the ground.
struct Clearance {
  double clearance_m = 2.0;  ///< least height above the ground, > 0
  int level = 26;            ///< of the ground, the finest that is looked at
};

/// The way of a camera that is to move from one place to another in one step, however far: it never leads
/// through the ground.
///
/// The way aims along the great circle of normals, heights linear, in chords that are no longer than the
/// camera's height above ground or a 64th of the motion. Wherever a chord would come nearer to the ground
/// than the clearance, its end is raised until it does not: a mountain between is flown over, and beyond it
/// the way comes down again. Where it ends, the camera is where it was to go, or straight above.
///
/// A chord is judged by planet::sight, which passes over no ridge, on the finest ground of which 64 cells
/// cover the chord; its end on the finest of which 64 cells cover the height above it, as the ground is drawn
/// under a camera; neither is finer than `level`. The last end is clear of the ground of `level`. That
/// ground, linear on the curved ellipsoid, is nowhere below the flat triangles that are drawn of it.
///
/// @param from, to  heights above the ellipsoid; a `from` that is too low is raised first
/// @returns the chords' ends, `from` left out, the last one where the camera stands
std::vector<geo::Geodetic> clear_way(const Surface& surface, const geo::Geodetic& from,
                                     const geo::Geodetic& to, const Clearance& keep);

}  // namespace globe::planet
