#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "globe/render/globe_renderer.h"
#include "tests/render/gl_fixture.h"

/// Cameras and pictures that the tests of the drawn ground share.
namespace views {

using glm::dvec3;
using globe::geo::Geodetic;
using globe::planet::Surface;
using globe::render::Camera;
using globe::render::GlobeRenderer;
using globe::render::RenderSettings;

struct Place {
  std::string name;
  double lat_deg;
  double lon_deg;
};

/// Corners of the octahedron, edges of diamonds, the equator's fold and the middles of faces.
inline const std::vector<Place>& hard_places() {
  static const std::vector<Place> places{{"north pole", 90, 0},        {"south pole", -90, 0},
                                         {"corner at 0", 0, 0},        {"corner at 90", 0, 90},
                                         {"corner at 180", 0, -180},   {"corner at 270", 0, -90},
                                         {"edge at 0 north", 41.3, 0}, {"edge at 180 south", -57.9, 180},
                                         {"fold at 30", 0, 30.7},      {"face N2", 35.2644, -135},
                                         {"face S0", -35.2644, 45},    {"beside a corner", 0.013, 89.983}};
  return places;
}

inline std::shared_ptr<const Surface> builtin_planet() {
  static const std::shared_ptr<const Surface> planet = Surface::builtin(1);
  return planet;
}

/// Settings for tests of geometry: a magenta background, no sky, shading no finer than the triangles.
inline RenderSettings geometry_settings(int detail) {
  RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(detail, 0);
  settings.background = glm::vec3(1.0f, 0.0f, 1.0f);
  return settings;
}

/// A camera at a height above the ground drawn under it.
inline Camera camera_above(const GlobeRenderer& renderer, const Surface& surface, const Place& place,
                           double above_m, double heading_deg, double pitch_deg, double fov_y_deg = 60.0) {
  Geodetic at{place.lat_deg, place.lon_deg, above_m};
  for (int round = 0; round < 3; ++round) {
    const dvec3 position = globe::geo::ecef_from_geodetic(surface.ellipsoid(), at);
    at.h_m += above_m - renderer.height_above_ground(position);
  }
  return globe::render::make_camera(surface.ellipsoid(), at, heading_deg, pitch_deg, fov_y_deg, 16.0 / 9.0);
}

/// Direction of a point of the picture, x and y in [-1, 1] from its middle.
inline dvec3 ray(const Camera& camera, double x, double y) {
  return glm::normalize(camera.forward + camera.right * (camera.tan_x() * x) +
                        camera.up * (camera.tan_y() * y));
}

/// The height above ground at which the finest level is `level` and its fade is about a half.
inline double mid_fade_height(const globe::clipmap::Settings& settings, const Surface& surface, int level) {
  return surface.root_edge() * settings.s / std::exp2(level + 0.25);
}

/// A sun on the planet's far side, not quite opposite: ground in view is black, and what is not shows the
/// background.
inline dvec3 midnight(const Camera& camera) {
  const dvec3 up = glm::normalize(camera.position);
  const dvec3 aside = glm::normalize(glm::cross(up, dvec3(0.3, 0.5, 0.8)));
  return -up * 0.866 + aside * 0.5;
}

}  // namespace views
