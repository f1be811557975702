#pragma once

#include <functional>

#include "globe/planet/surface.h"
#include "globe/planet/synthesis.h"

namespace globe::planet {

/// Height of any node of the data's finest level.
using HeightOfNode = std::function<double(const Node&)>;

inline constexpr int kMeasureMargin = 2;  ///< measuring a node looks so far

/// Measures the data at their finest level, for what is synthesised below: roughness and slope from a node
/// and its neighbours, and the carved relief the heights already hold.
///
/// `height`: of a tile with a guard kMeasureMargin nodes wider than what is to be measured. `height_of` is
/// asked around octahedron corners only, where the plane does not show who is whose neighbour.
void measure_ground(const Synthesis& synthesis, const TileValues<double>& height,
                    const HeightOfNode& height_of, SurfaceTile& tile);

}  // namespace globe::planet
