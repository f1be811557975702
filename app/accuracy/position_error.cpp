#include "app/accuracy/position_error.h"

#include "globe/clipmap/morph.h"

namespace app::accuracy {
namespace {

using globe::planet::Node;

constexpr double kHalfWidth = 640.0;  ///< of the picture, pixels
constexpr double kHalfHeight = 360.0;

/// Where a node's ground is drawn, ECEF metres in double.
dvec3 drawn_node(const Surface& surface, const Node& node) {
  return globe::geo::ecef_from_normal(surface.ellipsoid(), globe::planet::node_direction(node),
                                      surface.drawn_height(surface.height(node)));
}

}  // namespace

std::optional<glm::dvec2> pixel(const Camera& camera, const dvec3& relative) {
  const double w = glm::dot(relative, camera.forward);
  if (w <= 0.0) return std::nullopt;
  const glm::dvec2 ndc{glm::dot(relative, camera.right) / (w * camera.tan_x()),
                       glm::dot(relative, camera.up) / (w * camera.tan_y())};
  if (std::max(std::abs(ndc.x), std::abs(ndc.y)) > 1.0) return std::nullopt;
  return glm::dvec2(ndc.x * kHalfWidth, ndc.y * kHalfHeight);
}

glm::dvec2 pixel_of_clip(const glm::vec4& clip) {
  return {static_cast<double>(clip.x) / static_cast<double>(clip.w) * kHalfWidth,
          static_cast<double>(clip.y) / static_cast<double>(clip.w) * kHalfHeight};
}

dvec3 exact_place(const Surface& surface, const MeshProbe& probe, const ProbeVertex& vertex) {
  const Node& node = vertex.node;
  const dvec3 own = drawn_node(surface, node);
  if (vertex.on_rim || node.level == probe.settings().base_level || ((node.i | node.j) & 1) == 0) return own;
  const auto point = globe::clipmap::nadir(probe.state().target.u, node.level);
  const auto distance =
      globe::clipmap::hex_distance(globe::clipmap::images(point, node.d),
                                   {node.i * globe::clipmap::kSubcell, node.j * globe::clipmap::kSubcell});
  const auto alpha = static_cast<double>(
      globe::clipmap::morph_factor(globe::clipmap::morph_band(probe.settings()), distance));
  const auto ends = globe::planet::halved_edge(node.i, node.j);
  const dvec3 coarse = 0.5 * (drawn_node(surface, {node.d, node.level, ends[0].x, ends[0].y}) +
                              drawn_node(surface, {node.d, node.level, ends[1].x, ends[1].y}));
  return own + (coarse - own) * alpha;
}

/// Whether the planet's body hides a place, whatever the ground.
bool is_hidden(const Surface& surface, const Camera& camera, const dvec3& place) {
  const double distance = glm::length(place);
  const double body =
      globe::geo::ray_ellipsoid(surface.ellipsoid(), -1000.0, camera.position, place / distance);
  return body >= 0.0 && body < distance;
}

Camera camera_over(const Surface& surface, const dvec3& u, double above_m, double heading_deg,
                   double pitch_deg) {
  globe::geo::Geodetic place = globe::geo::degrees_from_normal(u);
  place.h_m = surface.drawn_height(surface.height(u, 20)) + above_m;
  return globe::render::make_camera(surface.ellipsoid(), place, heading_deg, pitch_deg, 60.0, 16.0 / 9.0);
}

std::vector<PositionHeight> position_heights() {
  return {{"eye", "eye height, 2 m", 2.0, -6.0},
          {"100m", "100 m", 100.0, -20.0},
          {"10km", "10 km", 1e4, -30.0},
          {"1000km", "1000 km", 1e6, -60.0},
          {"orbit", "orbit, 20,000 km", 2e7, -90.0}};
}

std::vector<globe::geo::Geodetic> position_places(const Scope& scope) {
  std::vector<globe::geo::Geodetic> result{{0.013, 89.983}, {35.2644, -135.0}};
  if (scope.full)
    result.insert(result.end(),
                  {{90.0, 0.0}, {-57.9, 180.0}, {41.3, 0.0}, {0.0, 30.7}, {47.0, 11.0}, {-33.0, -70.0}});
  return result;
}

Camera position_camera(const Surface& surface, const globe::geo::Geodetic& place,
                       const PositionHeight& height) {
  return camera_over(surface, globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), height.above_m,
                     70.0, height.pitch_deg);
}

globe::clipmap::Settings position_settings(globe::clipmap::Positions positions) {
  constexpr int kDetail = 64;
  globe::clipmap::Settings settings = globe::clipmap::Settings::for_detail(kDetail, 0);
  settings.positions = positions;
  return settings;
}

int finest_for(const MeshProbe& probe, const Surface& surface, double above_m) {
  return globe::clipmap::finest_level(probe.settings(), surface.root_edge(), above_m, 26).level;
}

void see_vertices(const Surface& surface, MeshProbe& probe, const Camera& camera, double above_m,
                  std::size_t wanted, const std::function<void(const Sighting&)>& see) {
  probe.load(camera.position, finest_for(probe, surface, above_m));
  const auto clip = probe.triangles(camera, 0.0f, MeshProbe::Space::kClip);
  const auto relative = probe.triangles(camera, 0.0f, MeshProbe::Space::kRelative);
  std::vector<std::size_t> in_view;
  for (std::size_t k = 0; k < clip.size(); ++k) {
    if (pixel(camera, dvec3(relative[k].seen))) in_view.push_back(k);
  }
  const std::size_t step = std::max<std::size_t>(in_view.size() / wanted, 1);
  for (std::size_t n = 0; n < in_view.size(); n += step) {
    const std::size_t k = in_view[n];
    const dvec3 place = exact_place(surface, probe, clip[k]);
    Sighting sighting{clip[k], place - camera.position};
    const auto true_pixel = pixel(camera, sighting.truth);
    if (!true_pixel) continue;
    sighting.off_m = glm::length(dvec3(relative[k].seen) - sighting.truth);
    sighting.off_px = glm::length(pixel_of_clip(clip[k].seen) - *true_pixel);
    const auto naive = pixel(camera, dvec3(glm::vec3(place) - glm::vec3(camera.position)));
    if (naive) sighting.naive_px = glm::length(*naive - *true_pixel);
    see(sighting);
  }
}

}  // namespace app::accuracy
