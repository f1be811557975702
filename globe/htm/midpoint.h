#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace globe::htm {

using glm::dvec3;

/// The vertex that HTM puts in the middle of edge ab: normalise(a + b).
/// @approximation geometry.midpoints
/// Symmetric in a and b bit for bit, so the two trixels beside an edge get the same vertex. Every vertex of
/// the mesh, the index, and the height grid comes from this one function (compiled without contraction).
/// Source: Szalay et al. 2005, "Indexing the Sphere with the Hierarchical Triangular Mesh", section 2.
inline dvec3 midpoint(const dvec3& a, const dvec3& b) {
  const dvec3 sum = a + b;
  const double scale = 1.0 / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  return {sum.x * scale, sum.y * scale, sum.z * scale};
}

}  // namespace globe::htm
