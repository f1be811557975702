#include <cstdio>
#include <utility>

#include "app/accuracy/position_error.h"
#include "app/accuracy/position_yardsticks.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/study.h"

namespace app::accuracy {
namespace {

using globe::clipmap::Positions;
using globe::clipmap::Settings;

constexpr std::size_t kDrawnCorners = 60000;  ///< of yardsticks, for their time

const std::vector<PositionHeight> kHeights = position_heights();

std::string place_text(const globe::geo::Geodetic& place, const dvec3& relative) {
  char text[80];
  std::snprintf(text, sizeof text, "%.4f,%.4f, %.3g m away", place.lat_deg, place.lon_deg,
                glm::length(relative));
  return text;
}

struct Mode {
  Positions positions;
  const char* bytes;
};
constexpr std::array kModes{Mode{Positions::kExact, "16 bytes a vertex, 16 for its morph target"},
                            Mode{Positions::kQuadratic, "4 bytes a vertex, 32 a knot every 4 cells"},
                            Mode{Positions::kChord, "4 bytes a vertex, 32 a knot every 8 cells"},
                            Mode{Positions::kFloat32, "16 bytes a vertex, 16 for its morph target"}};

/// A vertex in view that the yardsticks are held to, and the triangles beside it for their time.
struct Seen {
  globe::geo::Geodetic place;
  Camera camera;
  std::vector<dvec3> corners;  ///< ECEF metres; as many as make whole triangles
};

std::string sample_text(const PositionHeight& height, std::size_t views) {
  return std::to_string(kPositionVertices) + " vertices of each of " + std::to_string(views) +
         " views from " + height.words +
         ", at a corner of the octahedron and elsewhere; 1280x720, 60 degrees high";
}

Study mode_study(const PositionHeight& height, std::size_t views) {
  return {"positions." + height.name,
          "Places of vertices seen from " + height.words,
          "--positions",
          "the vertex's place in double precision, heights and morphing included",
          sample_text(height, views),
          "px",
          "ms a frame of 64x36 pixels",
          {}};
}

/// Errors of one way by height, and on the way the places of the vertices in view.
std::vector<ErrorSum> errors_of(const std::shared_ptr<const Surface>& surface, Positions positions,
                                const std::vector<globe::geo::Geodetic>& at,
                                std::vector<std::vector<Seen>>* seen) {
  MeshProbe probe(surface, position_settings(positions));
  std::vector<ErrorSum> sums(kHeights.size());
  for (std::size_t h = 0; h < kHeights.size(); ++h) {
    for (const auto& place : at) {
      const Camera camera = position_camera(*surface, place, kHeights[h]);
      Seen view{place, camera, {}};
      see_vertices(*surface, probe, camera, kHeights[h].above_m, kPositionVertices, [&](const Sighting& s) {
        if (is_hidden(*surface, camera, s.truth)) return;
        sums[h].add(s.off_px, [&] { return place_text(place, s.truth); });
        view.corners.push_back(camera.position + s.truth);
      });
      if (seen) (*seen)[h].push_back(std::move(view));
    }
  }
  return sums;
}

/// As many corners as make whole triangles, again and again.
std::vector<dvec3> repeated(const std::vector<dvec3>& corners, std::size_t count) {
  std::vector<dvec3> result;
  while (result.size() < count) result.push_back(corners[result.size() % corners.size()]);
  return result;
}

dvec3 ground_below(const Surface& surface, const globe::geo::Geodetic& place) {
  const dvec3 u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  return globe::geo::ecef_from_normal(surface.ellipsoid(), u, surface.drawn_height(surface.height(u, 20)));
}

Study yardstick_study(const std::shared_ptr<globe::gl::Context>& context, const Surface& surface,
                      const PositionHeight& height, const std::vector<Seen>& seen) {
  Study study{"positions." + height.name + ".yardsticks",
              "Places of vertices by other arithmetic, from " + height.words,
              "--positions",
              "the vertex's place in double precision",
              sample_text(height, seen.size()),
              "px",
              "ns a corner",
              {}};
  for (const Yardstick yardstick : kYardsticks) {
    ErrorSum sum;
    for (const Seen& view : seen) {
      const std::vector<dvec3> corners = repeated(view.corners, (view.corners.size() + 2) / 3 * 3);
      const auto clip =
          YardstickMesh(context, yardstick, corners, view.camera, ground_below(surface, view.place)).clip();
      for (std::size_t k = 0; k < view.corners.size(); ++k) {
        const dvec3 relative = corners[k] - view.camera.position;
        const auto truth = pixel(view.camera, relative);
        if (truth)
          sum.add(glm::length(pixel_of_clip(clip[k]) - *truth),
                  [&] { return place_text(view.place, relative); });
      }
    }
    const auto mesh = std::make_shared<const YardstickMesh>(
        context, yardstick, repeated(seen.front().corners, kDrawnCorners), seen.front().camera,
        ground_below(surface, seen.front().place));
    study.settings.push_back({name_of(yardstick), sum.figure(), [mesh] { return mesh->draw_ns(); },
                              yardstick == Yardstick::kAnchored,
                              std::to_string(bytes_a_vertex(yardstick)) + " bytes a vertex"});
  }
  return study;
}

/// The same errors against what the windows hold of a node, its height and what it morphs to included.
Study memory_study(Study study) {
  study.name = "positions.memory";
  study.title = "Places of vertices seen from eye height, against memory";
  study.cost_unit = "bytes a vertex";
  for (std::size_t k = 0; k < kModes.size(); ++k) {
    const Settings settings = position_settings(kModes[k].positions);
    const globe::render::ClipmapTextures textures(settings);
    const double nodes = static_cast<double>(settings.window()) * settings.window();
    constexpr double kShading = 5.0;  // a node's at shading level 0, which is no matter of its place
    study.settings[k].cost = fixed(static_cast<double>(textures.layer_bytes()) / nodes - kShading);
  }
  return study;
}

}  // namespace

std::vector<Study> position_studies(const Scope& scope) {
  const std::shared_ptr<const Surface>& surface = scope.planet;
  const auto at = position_places(scope);
  std::vector<Study> studies;
  studies.reserve(kHeights.size());
  for (const PositionHeight& height : kHeights) studies.push_back(mode_study(height, at.size()));
  std::vector<std::vector<Seen>> seen(kHeights.size());
  for (const Mode& mode : kModes) {
    const bool is_default = mode.positions == Positions::kExact;
    const auto sums = errors_of(surface, mode.positions, at, is_default ? &seen : nullptr);
    globe::render::RenderSettings ground;
    ground.clipmap = position_settings(mode.positions);  // in so small a picture nothing finer is seen
    const auto frame = remade<RepeatedFrame>(scope.context, surface, ground, 64, 36);
    for (std::size_t h = 0; h < kHeights.size(); ++h) {
      const Camera camera = position_camera(*surface, at.front(), kHeights[h]);
      const glm::dvec3 sun = sun_over(*surface, camera);
      studies[h].settings.push_back({std::string(globe::clipmap::name_of(mode.positions)), sums[h].figure(),
                                     [=] { return frame->get().draw_ms(camera, sun); }, is_default,
                                     mode.bytes});
      // One frame after another is drawn from all heights, and then not needed before the next pass.
      if (h + 1 == kHeights.size()) studies[h].settings.back().release = release_of(frame);
    }
  }
  studies.push_back(memory_study(studies.front()));
  for (std::size_t h = 0; h < kHeights.size(); ++h)
    studies.push_back(yardstick_study(scope.context, *surface, kHeights[h], seen[h]));
  return studies;
}

}  // namespace app::accuracy
