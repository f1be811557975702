#include "tests/bench/submission/index_orders.h"

#ifdef GLOBE_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <array>
#include <deque>

namespace bench {
namespace {

using globe::clipmap::PatchMesh;

using Triangle = std::array<std::uint16_t, 3>;

/// Every second row of triangles from its other end.
PatchMesh to_and_fro(const PatchMesh& mesh) {
  PatchMesh result = mesh;
  for (auto& indices : result.indices) {
    std::vector<std::vector<Triangle>> rows;
    int row = -1;
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      const Triangle triangle{indices[k], indices[k + 1], indices[k + 2]};
      int lowest = 255;
      for (const std::uint16_t v : triangle) lowest = std::min<int>(lowest, mesh.vertices[v][1]);
      if (lowest > row) {
        rows.emplace_back();
        row = lowest;
      }
      rows.back().push_back(triangle);
    }
    indices.clear();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (r % 2 == 1) std::reverse(rows[r].begin(), rows[r].end());
      for (const Triangle& triangle : rows[r])
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
  }
  return result;
}

#ifdef GLOBE_HAVE_MESHOPTIMIZER
template <class Optimize>
PatchMesh optimized(const PatchMesh& mesh, const Optimize& optimize) {
  PatchMesh result = mesh;
  for (auto& indices : result.indices) {
    std::vector<unsigned> from(indices.begin(), indices.end()), to(from.size());
    optimize(to.data(), from.data(), from.size(), mesh.vertices.size());
    std::transform(to.begin(), to.end(), indices.begin(),
                   [](unsigned v) { return static_cast<std::uint16_t>(v); });
  }
  return result;
}
#endif

}  // namespace

std::vector<IndexOrder> index_orders() {
  std::vector<IndexOrder> orders{{"row by row", [](const PatchMesh& mesh) { return mesh; }},
                                 {"rows to and fro", to_and_fro}};
#ifdef GLOBE_HAVE_MESHOPTIMIZER
  orders.push_back({"vertex cache (meshoptimizer)", [](const PatchMesh& mesh) {
                      return optimized(mesh, [](auto... a) { meshopt_optimizeVertexCache(a...); });
                    }});
  orders.push_back({"strip-like (meshoptimizer)", [](const PatchMesh& mesh) {
                      return optimized(mesh, [](auto... a) { meshopt_optimizeVertexCacheStrip(a...); });
                    }});
#endif
  return orders;
}

double cache_misses(const std::vector<std::uint16_t>& indices, std::size_t cache) {
  std::deque<std::uint16_t> held;
  std::size_t misses = 0;
  for (const std::uint16_t v : indices) {
    if (std::find(held.begin(), held.end(), v) != held.end()) continue;
    ++misses;
    held.push_back(v);
    if (held.size() > cache) held.pop_front();
  }
  return static_cast<double>(misses) / (static_cast<double>(indices.size()) / 3.0);
}

}  // namespace bench
