#pragma once

#include "globe/planet/surface.h"

namespace globe::planet {

/// How a height between the nodes of a level comes from them.
enum class Interpolation {
  kNearest,  ///< that of the nearest corner of the trixel
  kLinear,   ///< the flat trixel
  kCubic,    ///< smooth in slope, never outside the range of the nodes it is made of
};

struct Height {
  double height_m = 0;  ///< above the planet's vertical datum
  double spread_m = 0;  ///< highest less lowest corner of the level's trixel that holds the place
};

/// Height of the ground above a direction at a level (0 to kMaxLevel).
///
/// Cubic is Catmull and Rom's spline along i, then along j, over 4 x 4 nodes of the unfolded lattice; each of
/// the five splines is clamped to the range of its four values, so that no overshoot leaves the range of its
/// stencil. On a diamond's edge only nodes of the edge take part: both sides agree there.
Height height_at(const Surface& surface, const dvec3& u, int level, Interpolation interpolation);

/// The same by the data alone, of the nodes of the finest data there (Surface::data_at): nothing is
/// synthesised, in the rim of an inset its data and the planet's own are blended.
Height data_height_at(const Surface& surface, const dvec3& u, Interpolation interpolation);

}  // namespace globe::planet
