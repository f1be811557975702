#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "globe/planet/appearance.h"
#include "globe/planet/directions.h"
#include "globe/planet/surface.h"

namespace globe::preview {

using glm::dvec3;
using glm::vec3;

/// The ground at a direction, as the flat level-L trixel there has it.
struct Sample {
  double height_m = 0;
  vec3 albedo{0.0f};
  vec3 normal{0.0f};  ///< ECEF, unit
  bool water = false;
};

/// Looks the ground up at any place and level; colours and normals of a tile are worked out once.
class Sampler {
 public:
  explicit Sampler(std::shared_ptr<const planet::Surface> surface) : surface_(std::move(surface)) {}

  Sample at(const dvec3& u, int level);
  const planet::Surface& surface() const { return *surface_; }

 private:
  struct Shaded {
    std::shared_ptr<const planet::SurfaceTile> tile;
    std::vector<vec3> albedo, normal;
  };
  const Shaded& shaded(const planet::TileId& id);

  std::shared_ptr<const planet::Surface> surface_;
  std::unordered_map<std::uint64_t, Shaded> known_;
};

}  // namespace globe::preview
