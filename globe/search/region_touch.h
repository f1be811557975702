#pragma once

#include "globe/htm/region.h"

namespace globe::search {

/// Whether a great-circle arc (from a to b, unit, less than 180 degrees apart) has a point in a region.
///
/// Decided to 1e-13 rad, 0.6 micrometres on the Earth: an arc that comes so near counts as touching. Edges of
/// a polygon region should be shorter than 120 degrees.
///
/// Where neither end is in the region, the arc is asked for as the side of a sliver of a triangle, that
/// thick, and halved until the region's own test says that it is clear of it, or a point of it is inside.
bool touches(const htm::Region& region, const htm::dvec3& a, const htm::dvec3& b);

}  // namespace globe::search
