#include "globe/clipmap/cut.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "globe/clipmap/level_data.h"
#include "globe/clipmap/morphed_patch.h"

namespace globe::clipmap {
namespace {

/// Where an edge crosses the plane, computed from its end above it whichever way round it is given.
dvec3 crossing(const dvec3& a, double above_a, const dvec3& b, double above_b) {
  return above_a >= 0.0 ? a + (b - a) * (above_a / (above_a - above_b))
                        : b + (a - b) * (above_b / (above_b - above_a));
}

}  // namespace

std::vector<std::array<dvec3, 2>> cut(const Settings& settings, const ClipmapState& state,
                                      const FinestLevel& shown, const CuttingPlane& plane) {
  const PatchMesh mesh = make_patch_mesh(settings.m);
  std::vector<std::array<dvec3, 2>> result;
  std::vector<double> above;
  for (int level = settings.base_level; level <= shown.level; ++level) {
    const auto data_of = [&](int l) -> const LevelData& {
      return *state.levels[static_cast<std::size_t>(l - settings.base_level)];
    };
    const LevelData& data = data_of(level);
    for (std::size_t p = 0; p < data.patches.size(); ++p) {
      const Patch& patch = data.patches[p];
      const dvec3 from = data.anchor + dvec3(data.bounds[p].centre) - plane.centre;
      const auto radius = static_cast<double>(data.bounds[p].radius);
      if (std::abs(glm::dot(from, plane.normal)) > radius || glm::length(from) > plane.radius + radius)
        continue;
      if (level < shown.level && data_of(level + 1).region.holds(patch.trixel)) continue;
      const auto d = static_cast<std::size_t>(patch.trixel.d);
      const NodeRect& nodes = data.vertices[d];
      const std::vector<MorphedVertex> vertices = morphed_vertices(
          settings, mesh, {patch, level, state.target.u, level == shown.level ? shown.fade : 0.0f},
          [&](const ivec2& node) {
            const auto at =
                static_cast<std::size_t>(node.y - nodes.j0) * static_cast<std::size_t>(nodes.width()) +
                static_cast<std::size_t>(node.x - nodes.i0);
            return data.anchor + dvec3(data.positions[d][at]);
          });
      above.clear();
      for (const MorphedVertex& vertex : vertices)
        above.push_back(glm::dot(vertex.position - plane.centre, plane.normal));
      const std::vector<std::uint16_t>& index = mesh.indices[static_cast<std::size_t>(patch.rim)];
      for (std::size_t k = 0; k < index.size(); k += 3) {
        std::array<dvec3, 2> ends;
        std::size_t found = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t a = index[k + c], b = index[k + (c + 1) % 3];
          if ((above[a] >= 0.0) == (above[b] >= 0.0)) continue;
          ends[found++] = crossing(vertices[a].position, above[a], vertices[b].position, above[b]);
        }
        if (found == 2) result.push_back(ends);
      }
    }
  }
  return result;
}

}  // namespace globe::clipmap
