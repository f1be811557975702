#include "app/standing_camera.h"

#include <algorithm>
#include <cstdio>

#include "app/parse_options.h"
#include "globe/base/error.h"

namespace app {

globe::geo::Geodetic standing_place(const Point& at, bool agl, const globe::geo::Ellipsoid& ellipsoid,
                                    const std::function<double(const glm::dvec3&)>& height_above_ground) {
  globe::geo::Geodetic place = at.position;
  const double given = place.h_m;
  const auto above = [&] { return height_above_ground(globe::geo::ecef_from_geodetic(ellipsoid, place)); };
  if (agl) {
    place.h_m = std::max(given, 0.0);  // over a sea from its level, not from the floor
    place.h_m += given - above();
  }
  const double least = least_clearance(ellipsoid);
  const double low = above();
  if (low >= least) return place;
  if (!agl || given < least) {
    const char* text = least >= 1.0
                           ? "globe: warning: the camera is %.1f m below %.0f m above ground; raised\n"
                           : "globe: warning: the camera is %.3g m below %.3g m above ground; raised\n";
    std::fprintf(stderr, text, least - low, least);
  }
  place.h_m += least - low;
  if (place.h_m >= 0.0 && place.h_m < least - low)
    place.h_m += std::max(least - above(), 0.0);  // out of shallows
  return place;
}

std::optional<Look> look_of(const globe::scene::StandingCamera& camera) {
  if (!camera.look) return std::nullopt;
  return Look{camera.look->heading_deg, camera.look->pitch_deg, camera.roll_deg};
}

void add_stand_options(CLI::App& command, StandOptions& options) {
  command.add_option("--at", options.at, "where the camera stands: LAT,LON[,ALT]; not needed with a scene");
  command.add_option("--moment", options.moment_s, "seconds from the beginning of a scene's path")
      ->capture_default_str()
      ->check(in_range(0.0, 1e9));
}

globe::geo::Geodetic target_of(const StandOptions& options, const std::optional<globe::scene::Scene>& scene) {
  if (!options.at.empty()) return parse_point(options.at).position;
  if (scene && scene->camera) return scene->camera->at.position;
  if (scene && scene->path) return scene->path->keys.back().place;
  throw globe::UsageError("--at", "nothing says where the camera stands",
                          "give --at LAT,LON,ALT, or a scene with a [camera] or a [path]");
}

Standpoint standpoint(const StandOptions& options, const CameraOptions& camera,
                      const std::optional<globe::scene::Scene>& scene,
                      const std::shared_ptr<const globe::planet::Surface>& surface, int max_level,
                      const std::function<double(const glm::dvec3&)>& height_above_ground) {
  Standpoint stand{{}, {0.0, -90.0}};
  if (scene && scene->camera) stand.look = look_of(*scene->camera).value_or(stand.look);
  if (!options.at.empty()) {
    stand.place =
        standing_place(parse_point(options.at), camera.agl, surface->ellipsoid(), height_above_ground);
  } else if (scene->camera) {
    stand.place = standing_place(scene->camera->at, camera.agl || scene->camera->agl, surface->ellipsoid(),
                                 height_above_ground);
  } else {
    const Flight flight(clipmap_settings(camera), surface, max_level, *scene->path);
    const Flight::View view = flight.at(std::min(options.moment_s / flight.duration_s(), 1.0), true);
    stand = {view.place, view.look};
  }
  if (!camera.look.empty()) stand.look = parse_look(camera.look);
  return stand;
}

}  // namespace app
