#include "globe/clipmap/morphed_patch.h"

#include <algorithm>

#include "globe/clipmap/morph.h"
#include "globe/planet/grid.h"

namespace globe::clipmap {
namespace {

dvec3 exact_mix(const dvec3& a, const dvec3& b, double t) {
  return t >= 1.0 ? b : t <= 0.0 ? a : a + (b - a) * t;
}

}  // namespace

std::vector<MorphedVertex> morphed_vertices(const Settings& settings, const PatchMesh& mesh,
                                            const SeenPatch& seen,
                                            const std::function<dvec3(const ivec2& node)>& place) {
  const LatticeTrixel& trixel = seen.patch.trixel;
  const MorphBand band = morph_band(settings);
  const bool morphs = seen.level > settings.base_level;
  const std::vector<LatticePoint> seen_nadir = images(nadir(seen.nadir, seen.level), trixel.d);
  std::vector<MorphedVertex> result;
  result.reserve(mesh.vertices.size());
  for (const auto& [a, b] : mesh.vertices) {
    const ivec2 node = patch_node(trixel, settings.m, a, b);
    const dvec3 own = place(node);
    float alpha = 0.0f;
    if (morphs)
      alpha = std::max(seen.fade,
                       morph_factor(band, hex_distance(seen_nadir, {node.x * kSubcell, node.y * kSubcell})));
    if (alpha == 0.0f || ((node.x | node.y) & 1) == 0) {
      result.push_back({own, alpha});
      continue;
    }
    const auto ends = planet::halved_edge(node.x, node.y);
    const dvec3 coarse = (place(ends[0]) + place(ends[1])) * 0.5;
    result.push_back({exact_mix(own, coarse, static_cast<double>(alpha)), alpha});
  }
  return result;
}

}  // namespace globe::clipmap
