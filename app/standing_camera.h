#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "app/flight.h"
#include "app/point.h"
#include "app/view_options.h"
#include "globe/geo/ellipsoid.h"

namespace app {

/// Where the camera of a single picture stands: ALT counts from the ellipsoid, with --agl from the ground. A
/// camera lower than least_clearance is raised to that, with a warning when it was not asked for.
///
/// @param height_above_ground  of a position in ECEF, metres
globe::geo::Geodetic standing_place(const Point& at, bool agl, const globe::geo::Ellipsoid& ellipsoid,
                                    const std::function<double(const glm::dvec3&)>& height_above_ground);

/// From where a single picture is taken: what shot and pick share.
struct Standpoint {
  globe::geo::Geodetic place;
  Look look;
};

/// A scene's camera's; none: it says nothing.
std::optional<Look> look_of(const globe::scene::StandingCamera& camera);

/// --at and --moment as they are written.
struct StandOptions {
  std::string at;
  double moment_s = 0;
};
void add_stand_options(CLI::App& command, StandOptions& options);

/// The place that the sun without a time shines on at ten in the morning: the camera's, or the last one of a
/// path. Throws UsageError when neither --at nor a scene says where the camera stands.
globe::geo::Geodetic target_of(const StandOptions& options, const std::optional<globe::scene::Scene>& scene);

/// --at, with --agl, else the scene's camera, else its path at --moment; --look before theirs, straight down
/// when nothing is said. REQUIRES: target_of did not throw.
Standpoint standpoint(const StandOptions& options, const CameraOptions& camera,
                      const std::optional<globe::scene::Scene>& scene,
                      const std::shared_ptr<const globe::planet::Surface>& surface, int max_level,
                      const std::function<double(const glm::dvec3&)>& height_above_ground);

}  // namespace app
