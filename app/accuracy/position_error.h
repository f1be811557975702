#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/accuracy/mesh_probe.h"
#include "app/accuracy/study.h"

namespace app::accuracy {

/// Pixel of a camera-relative point from the middle of a 1280x720 view; nothing outside it.
std::optional<glm::dvec2> pixel(const Camera& camera, const dvec3& relative);

glm::dvec2 pixel_of_clip(const glm::vec4& clip);

/// The place of a drawn vertex in double, ECEF metres, its morph included.
dvec3 exact_place(const Surface& surface, const MeshProbe& probe, const ProbeVertex& vertex);

/// Whether the planet's body hides a place (metres from the camera), whatever the ground.
bool is_hidden(const Surface& surface, const Camera& camera, const dvec3& place);

/// A camera above a place, low over the ground drawn there, or as high as asked.
Camera camera_over(const Surface& surface, const dvec3& u, double above_m, double heading_deg,
                   double pitch_deg);

/// The finest level drawn from a height above ground.
int finest_for(const MeshProbe& probe, const Surface& surface, double above_m);

/// A drawn vertex in view, as the GPU has it and as it should be.
struct Sighting {
  ProbeVertex vertex;
  dvec3 truth;          ///< metres from the camera
  double off_m = 0;     ///< of what the vertex shader puts out
  double off_px = 0;    ///< in the picture
  double naive_px = 0;  ///< what coordinates from the planet's centre rounded to fp32 would be off
};

/// Shows `see` some `wanted` of the vertices in view.
void see_vertices(const Surface& surface, MeshProbe& probe, const Camera& camera, double above_m,
                  std::size_t wanted, const std::function<void(const Sighting&)>& see);

/// What places of vertices are judged by: cameras at each height over each place, and as many vertices of
/// each view.
struct PositionHeight {
  std::string name, words;
  double above_m;
  double pitch_deg;
};
std::vector<PositionHeight> position_heights();
/// Beside an octahedron's corner, in the middle of a face; in full also at a pole, on edges of diamonds, and
/// elsewhere.
std::vector<globe::geo::Geodetic> position_places(const Scope& scope);
Camera position_camera(const Surface& surface, const globe::geo::Geodetic& place,
                       const PositionHeight& height);
globe::clipmap::Settings position_settings(globe::clipmap::Positions positions);
constexpr std::size_t kPositionVertices = 2000;

}  // namespace app::accuracy
