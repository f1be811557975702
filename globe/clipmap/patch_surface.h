#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "globe/clipmap/region.h"
#include "globe/clipmap/settings.h"
#include "globe/geo/ellipsoid.h"

namespace globe::clipmap {

/// What the places of vertices are interpolated from: knots on the lattice of Settings::knot_step cells.
///
/// With chords a knot is a patch's corner: `surface` holds E(u) from the level's anchor and `normal` u. With
/// quadratic patches the knots between two corners are there too; their `surface` is how far E(u) stands out
/// from the middle of the corners' chord.
struct KnotBlock {
  NodeRect knots;                  ///< in steps of the knots' lattice
  std::vector<glm::vec4> surface;  ///< row by row, i fastest; metres, w unused
  std::vector<glm::vec4> normal;
};

/// The knots around a rectangle of nodes, computed in double and rounded once.
KnotBlock make_knots(const Settings& settings, const geo::Ellipsoid& ellipsoid, int level, int d,
                     const NodeRect& nodes, const dvec3& anchor);

/// Where the shader puts a node (shaders/lib/patch_surface.glsl, the same bits): metres from the anchor.
/// @param knots  around it
glm::vec3 patch_surface(const Settings& settings, const KnotBlock& knots, int i, int j, float height);

}  // namespace globe::clipmap
