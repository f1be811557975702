#include "globe/render/room.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace globe::render {

glm::dvec4 Room::inside_m(const glm::dvec3& ecef) const {
  const glm::dvec3 at = (ecef - origin) * axes;
  return {at.x - low.x, high.x - at.x, at.y - low.y, high.y - at.y};
}

bool Room::holds(const glm::dvec3& ecef) const { return side_of(*this, ecef, 0.0) == RoomSide::kInside; }

RoomSide side_of(const Room& room, const glm::dvec3& centre, double radius) {
  // The planet's other half lies in the same prism.
  if (glm::dot(centre, room.axes[2]) < -radius) return RoomSide::kOutside;
  const glm::dvec4 inside = room.inside_m(centre);
  const double least = std::min({inside.x, inside.y, inside.z, inside.w});
  return least > radius ? RoomSide::kInside : least < -radius ? RoomSide::kOutside : RoomSide::kAcross;
}

}  // namespace globe::render
