#pragma once

#include <functional>
#include <string>
#include <vector>

#include "globe/clipmap/patch.h"

namespace bench {

/// An order for the triangles of a patch.
struct IndexOrder {
  std::string name;
  std::function<globe::clipmap::PatchMesh(const globe::clipmap::PatchMesh&)> reorder;
};

/// As the renderer has them first, row by row; rows to and fro; and meshoptimizer's orders for a vertex cache
/// and for strips, where it is installed (libmeshoptimizer-dev).
std::vector<IndexOrder> index_orders();

/// Vertices transformed for a triangle, by a first-in first-out cache of so many vertices.
double cache_misses(const std::vector<std::uint16_t>& indices, std::size_t cache);

}  // namespace bench
