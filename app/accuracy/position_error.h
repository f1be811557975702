#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "app/accuracy/mesh_probe.h"

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

}  // namespace app::accuracy
