#include "app/view/eye.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"

namespace app::view {

using glm::dvec2;
using glm::dvec3;
using globe::kDegree;
namespace geo = globe::geo;

globe::render::Camera Eye::camera(const Standpoint& stand) const {
  return globe::render::rolled(globe::render::make_camera(ellipsoid, stand.place, stand.look.heading_deg,
                                                          stand.look.pitch_deg, fov_deg, size.x / size.y),
                               stand.look.roll_deg);
}

dvec3 Eye::direction(const globe::render::Camera& camera, dvec2 pixel) const {
  return globe::render::direction_through(camera, pixel.x / size.x, pixel.y / size.y);
}

dvec3 Eye::direction_in_view(dvec2 pixel) const {
  const double tan_y = std::tan(0.5 * fov_deg * kDegree);
  return {tan_y * size.x / size.y * (2.0 * pixel.x / size.x - 1.0), tan_y * (1.0 - 2.0 * pixel.y / size.y),
          1.0};
}

std::optional<dvec2> Eye::pixel_of(const globe::render::Camera& camera, const dvec3& place) const {
  const dvec3 relative = place - camera.position;
  const double depth = glm::dot(relative, camera.forward);
  if (!(depth > 0.0)) return std::nullopt;
  const double x = glm::dot(relative, camera.right) / (depth * camera.tan_x());
  const double y = glm::dot(relative, camera.up) / (depth * camera.tan_y());
  return dvec2(0.5 * (1.0 + x), 0.5 * (1.0 - y)) * size;
}

Look aimed(const Eye& eye, const Standpoint& stand, const dvec3& direction, dvec2 pixel) {
  const geo::LocalFrame frame = geo::local_frame(stand.place.lat_deg, stand.place.lon_deg);
  const dvec3 toward = glm::normalize(direction);
  const dvec3 seen = glm::normalize(eye.direction_in_view(pixel));
  // Upward the direction is seen.y cos(pitch) + seen.z sin(pitch) = reach sin(pitch + phase).
  const double reach = std::hypot(seen.y, seen.z);
  const double phase = std::atan2(seen.y, seen.z);
  const double rise = std::asin(std::clamp(glm::dot(toward, frame.up) / reach, -1.0, 1.0));
  const double old = stand.look.pitch_deg * kDegree;
  const auto folded = [](double angle) { return std::remainder(angle, 360.0 * kDegree); };
  const double first = folded(rise - phase), second = folded(180.0 * kDegree - rise - phase);
  const double nearer = std::abs(first - old) <= std::abs(second - old) ? first : second;
  const double pitch = std::clamp(nearer, -90.0 * kDegree, 90.0 * kDegree);
  const double ahead = seen.z * std::cos(pitch) - seen.y * std::sin(pitch);
  const double east = glm::dot(toward, frame.east), north = glm::dot(toward, frame.north);
  const double heading = std::atan2(east, north) - std::atan2(seen.x, ahead);
  return {folded(heading) / kDegree, pitch / kDegree, 0.0};
}

}  // namespace app::view
