#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "globe/clipmap/patch_surface.h"
#include "globe/clipmap/region.h"
#include "globe/clipmap/settings.h"
#include "globe/planet/surface.h"

namespace globe::clipmap {

/// A rectangle of one layer's vertices to upload. Positions (metres from the level's anchor, fp32) and, in w,
/// height; or, where positions are interpolated, heights and the knots around.
struct VertexBlock {
  int d = 0;
  NodeRect nodes;                   ///< nodes of the level
  std::vector<glm::vec4> position;  ///< row by row, i fastest; where the shader puts it if it interpolates
  std::vector<glm::vec4>
      coarse;  ///< where the vertex goes at α = 1: halfway between the coarser level's two vertices
  std::vector<float> height;  ///< empty unless positions are interpolated; `coarse` is empty then
  KnotBlock knots;

  std::size_t upload_bytes() const;
};

/// Positions of a rectangle of nodes in double, ECEF metres from an anchor, with the drawn height in w.
struct PositionGrid {
  NodeRect nodes;
  std::vector<glm::dvec4> values;  ///< row by row, i fastest

  const glm::dvec4& at(int i, int j) const {
    return values[static_cast<std::size_t>(j - nodes.j0) * static_cast<std::size_t>(nodes.width()) +
                  static_cast<std::size_t>(i - nodes.i0)];
  }
};
PositionGrid exact_positions(const planet::Surface& surface, int level, int d, const NodeRect& nodes,
                             const dvec3& anchor);

/// What `settings.positions` asks for. Safe to call from any thread.
VertexBlock make_vertex_block(const Settings& settings, const planet::Surface& surface, int level, int d,
                              const NodeRect& nodes, const dvec3& anchor);

}  // namespace globe::clipmap
