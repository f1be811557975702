#pragma once

#include <functional>
#include <vector>

#include "globe/clipmap/patch.h"
#include "globe/clipmap/settings.h"

namespace globe::clipmap {

/// A vertex where it is drawn.
struct MorphedVertex {
  dvec3 position;   ///< ECEF metres
  float alpha = 0;  ///< 0 the level's own ground, 1 the coarser level's
};

/// A patch as it is seen from a camera.
struct SeenPatch {
  const Patch& patch;
  int level;
  const dvec3& nadir;  ///< the camera's normal
  float fade;          ///< morph factor the level has at least
};

/// The vertices of a patch morphed as shaders/clipmap.vert does it, in the order of PatchMesh::vertices.
///
/// Vertices that the coarser level has too stay where they are; the rim of a region is made of such alone.
/// @param place  of a node of the level, ECEF metres; asked for nodes of the patch only
std::vector<MorphedVertex> morphed_vertices(const Settings& settings, const PatchMesh& mesh,
                                            const SeenPatch& seen,
                                            const std::function<dvec3(const ivec2& node)>& place);

}  // namespace globe::clipmap
