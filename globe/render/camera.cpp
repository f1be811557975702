#include "globe/render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace globe::render {

double Camera::tan_y() const { return std::tan(fov_y_deg * std::numbers::pi / 360.0); }

Camera make_camera(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& place, double heading_deg,
                   double pitch_deg, double fov_y_deg, double aspect) {
  const geo::LocalFrame frame = geo::local_frame(place.lat_deg, place.lon_deg);
  Camera camera;
  camera.position = geo::ecef_from_geodetic(ellipsoid, place);
  camera.forward = geo::look_direction(frame, heading_deg, pitch_deg);
  camera.up = geo::look_direction(frame, heading_deg, pitch_deg + 90.0);
  camera.right = glm::cross(camera.forward, camera.up);
  camera.fov_y_deg = fov_y_deg;
  camera.aspect = aspect;
  return camera;
}

Camera rolled(const Camera& camera, double roll_deg) {
  if (roll_deg == 0.0) return camera;
  const double roll = roll_deg * std::numbers::pi / 180.0;
  Camera turned = camera;
  turned.right = camera.right * std::cos(roll) - camera.up * std::sin(roll);
  turned.up = camera.up * std::cos(roll) + camera.right * std::sin(roll);
  return turned;
}

dvec3 direction_through(const Camera& camera, double x, double y) {
  return glm::normalize(camera.forward + camera.right * (camera.tan_x() * (2.0 * x - 1.0)) +
                        camera.up * (camera.tan_y() * (1.0 - 2.0 * y)));
}

dmat4 clip_from_relative(const Camera& camera, double near_m) {
  const double x = 1.0 / camera.tan_x();
  const double y = 1.0 / camera.tan_y();
  const dvec3& r = camera.right;
  const dvec3& u = camera.up;
  const dvec3& f = camera.forward;
  // Columns; clip z is the near distance itself and w the distance along the view axis.
  return {{r.x * x, u.x * y, 0.0, f.x},
          {r.y * x, u.y * y, 0.0, f.y},
          {r.z * x, u.z * y, 0.0, f.z},
          {0.0, 0.0, near_m, 0.0}};
}

double near_distance(const geo::Ellipsoid& ellipsoid, double height_above_ground_m) {
  const double scale = ellipsoid.mean_radius() / geo::kWgs84.mean_radius();
  return std::clamp(height_above_ground_m / 4.0, 1e-3 * scale, 0.05 * scale);
}

}  // namespace globe::render
