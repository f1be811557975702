#include "flat/box.h"

#include <glm/geometric.hpp>

namespace globe::flat {

Box patch_box(const Terrain& terrain, std::size_t patch) {
  const auto east = static_cast<std::size_t>(terrain.patches_east());
  const int column = static_cast<int>(patch % east) * kPatchCells;
  const int row = static_cast<int>(patch / east) * kPatchCells;
  const PatchSummary& summary = terrain.patch(patch);
  return {{terrain.x_m(column), terrain.y_m(row), summary.lowest_m},
          {terrain.x_m(column + kPatchCells), terrain.y_m(row + kPatchCells), summary.highest_m}};
}

bool is_in_view(const clipmap::Frustum& frustum, const Box& box, const dvec3& eye) {
  const auto outside = [&](const dvec3& inward) {
    const dvec3 farthest(inward.x > 0.0 ? box.high.x : box.low.x, inward.y > 0.0 ? box.high.y : box.low.y,
                         inward.z > 0.0 ? box.high.z : box.low.z);
    return glm::dot(inward, farthest - eye) < 0.0;
  };
  for (const dvec3& side : frustum.sides) {
    if (outside(side)) return false;
  }
  return !outside(frustum.forward);
}

}  // namespace globe::flat
