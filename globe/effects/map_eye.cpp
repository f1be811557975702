#include "globe/effects/map_eye.h"

#include <cmath>

namespace globe::effects {

MapEye map_eye(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& eye) {
  const glm::dvec3 up = geo::normal_from_degrees(eye.lat_deg, eye.lon_deg);
  const glm::dvec3 east = geo::local_frame(eye.lat_deg, eye.lon_deg).east;
  const double e2 = ellipsoid.f * (2.0 - ellipsoid.f);
  const double cosine = std::hypot(up.x, up.y);
  const double vertical = ellipsoid.a / std::sqrt(1.0 - e2 * up.z * up.z) + eye.h_m;
  return {glm::vec4(glm::dvec4(east.y, -east.x, up.z, cosine)),
          glm::vec4(glm::dvec4(vertical * cosine, vertical, ellipsoid.a, e2))};
}

}  // namespace globe::effects
