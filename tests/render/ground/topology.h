#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

#include "app/accuracy/mesh_probe.h"
#include "tests/render/ground/views.h"

namespace views {

/// The bits of a position, zero without its sign.
using Bits = std::array<std::uint32_t, 3>;

inline Bits bits(const glm::vec4& v) {
  Bits result;
  for (int k = 0; k < 3; ++k) {
    const float x = v[k] == 0.0f ? 0.0f : v[k];
    std::memcpy(&result[static_cast<std::size_t>(k)], &x, sizeof x);
  }
  return result;
}

/// What is wrong with a surface of triangles that ought to be a sphere.
struct Topology {
  std::size_t open_edges = 0;  ///< not used exactly twice
  std::size_t edges = 0;
  long euler = 0;  ///< V - E + F
};

inline Topology topology(const std::vector<app::accuracy::ProbeVertex>& triangles) {
  std::map<Bits, std::uint32_t> number;
  std::vector<std::uint32_t> corner;
  corner.reserve(triangles.size());
  for (const app::accuracy::ProbeVertex& v : triangles) {
    corner.push_back(
        number.try_emplace(bits(v.seen), static_cast<std::uint32_t>(number.size())).first->second);
  }
  std::vector<std::uint64_t> edges;
  for (std::size_t t = 0; t < corner.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = corner[t + k], b = corner[t + (k + 1) % 3];
      edges.push_back(std::min(a, b) << 32 | std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  Topology result;
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t end = k;
    while (end < edges.size() && edges[end] == edges[k]) ++end;
    result.open_edges += end - k == 2 ? 0 : 1;
    ++result.edges;
    k = end;
  }
  result.euler = static_cast<long>(number.size()) - static_cast<long>(result.edges) +
                 static_cast<long>(triangles.size() / 3);
  return result;
}

}  // namespace views
