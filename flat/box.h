#pragma once

#include "flat/terrain.h"
#include "globe/clipmap/culling.h"

namespace globe::flat {

/// An axis-parallel box of the frame, metres.
struct Box {
  dvec3 low, high;
};

/// Around everything that is drawn of a patch at any level.
Box patch_box(const Terrain& terrain, std::size_t patch);

/// False only when the box is wholly outside one of the planes: of the eight corners the one farthest along
/// the plane's normal decides.
/// @param frustum  in the axes of the frame
bool is_in_view(const clipmap::Frustum& frustum, const Box& box, const dvec3& eye);

}  // namespace globe::flat
