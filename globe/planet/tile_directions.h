#pragma once

#include <vector>

#include "globe/planet/subdivision.h"

namespace globe::planet {

/// Geodetic normals of a tile's own nodes: four walks for the corners, halved edges for the rest;
/// bit-identical to node_direction at a twentieth of its cost.
class TileDirections {
 public:
  explicit TileDirections(const TileId& id);

  const dvec3& at(int i, int j) const {
    return values_[static_cast<std::size_t>(j - id_.first_j()) * static_cast<std::size_t>(id_.cells() + 1) +
                   static_cast<std::size_t>(i - id_.first_i())];
  }

 private:
  TileId id_;
  std::vector<dvec3> values_;
};

}  // namespace globe::planet
