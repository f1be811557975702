#pragma once

#include <vector>

#include "globe/clipmap/region.h"
#include "globe/clipmap/settings.h"

namespace globe::clipmap {

/// The nodes of a diamond that its textures hold for a region: rectangles without overlap. With the plain
/// windows all of the rectangle around it; with hexagons, strips of Settings::strip_rows() rows as long as
/// the region is there, so that the rows of a strip have at most that many nodes more than they need, less
/// one.
std::vector<NodeRect> footprint(const Settings& settings, const Region& region, int d);

}  // namespace globe::clipmap
