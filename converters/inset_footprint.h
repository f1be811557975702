#pragma once

#include <vector>

#include "converters/map_geometry.h"
#include "globe/planet/dataset.h"

namespace converters {

/// Blocks of InsetGrid<>::kTile nodes a side (one more at the far edges of a diamond) of a level that
/// together hold every node that lies on one of the maps or up to `margin` edges beside it; some more may be
/// among them. REQUIRES: the level has as many nodes a side.
std::vector<globe::planet::InsetBlock> footprint_blocks(const std::vector<MapGeometry>& maps, int level,
                                                        int margin);

/// The smallest rectangle around the blocks of each diamond.
std::vector<globe::planet::InsetBlock> bounds_of(const std::vector<globe::planet::InsetBlock>& blocks);

}  // namespace converters
