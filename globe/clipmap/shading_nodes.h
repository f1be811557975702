#pragma once

#include "globe/clipmap/lighting.h"
#include "globe/planet/surface.h"

namespace globe::clipmap {

/// Normals and albedo of a rectangle of nodes of one diamond, for per-pixel shading.
///
/// The normal is that of the drawn ground by central differences over the six lattice neighbours, in the
/// diamond's shading frame (shading_axis). The lattice's metric is taken from node directions every 16 cells
/// and interpolated between: an error in the slope's direction below 1 % from level 8 on. Under water the
/// relief fades with depth as the light does.
/// @param coloring  null: the ground's own
ShadingNodes make_shading_nodes(const planet::Surface& surface, int level, int d, const NodeRect& nodes,
                                const planet::Coloring* coloring = nullptr);

}  // namespace globe::clipmap
