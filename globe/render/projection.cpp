#include "globe/render/projection.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace globe::render {
namespace {

constexpr double kPi = std::numbers::pi;

double fov_radians(const Camera& camera) { return camera.fov_y_deg * kPi / 180.0; }

}  // namespace

std::optional<Projection> projection_by_name(std::string_view name) {
  if (name == "perspective") return Projection::kPerspective;
  if (name == "fisheye") return Projection::kFisheye;
  if (name == "equirectangular") return Projection::kEquirectangular;
  return std::nullopt;
}

double widest_fov_deg(Projection projection) {
  return projection == Projection::kPerspective ? 170.0 : projection == Projection::kFisheye ? 360.0 : 180.0;
}

double usual_fov_deg(Projection projection) { return projection == Projection::kPerspective ? 60.0 : 180.0; }

std::optional<dvec3> direction_through(Projection projection, const Camera& camera, double x, double y) {
  if (projection == Projection::kPerspective) return direction_through(camera, x, y);
  // In half picture heights from the middle.
  const double right = (2.0 * x - 1.0) * camera.aspect, up = 1.0 - 2.0 * y;
  if (projection == Projection::kFisheye) {
    const double radius = std::hypot(right, up);
    if (radius > 1.0) return std::nullopt;
    if (radius == 0.0) return camera.forward;
    const double angle = 0.5 * fov_radians(camera) * radius;
    return camera.forward * std::cos(angle) +
           (camera.right * right + camera.up * up) * (std::sin(angle) / radius);
  }
  const double around = 0.5 * fov_radians(camera) * right, above = 0.5 * fov_radians(camera) * up;
  if (std::abs(around) > kPi) return std::nullopt;
  return (camera.forward * std::cos(around) + camera.right * std::sin(around)) * std::cos(above) +
         camera.up * std::sin(above);
}

std::optional<glm::dvec2> seen_at(Projection projection, const Camera& camera, const dvec3& direction) {
  const double right = glm::dot(direction, camera.right), up = glm::dot(direction, camera.up),
               ahead = glm::dot(direction, camera.forward);
  glm::dvec2 at;  // in half picture heights from the middle
  if (projection == Projection::kPerspective) {
    if (ahead <= 0.0) return std::nullopt;
    at = glm::dvec2(right, up) / (ahead * camera.tan_y());
  } else if (projection == Projection::kFisheye) {
    const double aside = std::hypot(right, up);
    const double radius = std::atan2(aside, ahead) / (0.5 * fov_radians(camera));
    if (radius > 1.0) return std::nullopt;
    at = aside > 0.0 ? glm::dvec2(right, up) * (radius / aside) : glm::dvec2(0.0);
  } else {
    at = glm::dvec2(std::atan2(right, ahead), std::atan2(up, std::hypot(right, ahead))) /
         (0.5 * fov_radians(camera));
  }
  return glm::dvec2(0.5 * (1.0 + at.x / camera.aspect), 0.5 * (1.0 - at.y));
}

}  // namespace globe::render
