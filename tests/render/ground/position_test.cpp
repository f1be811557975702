// H1: where the GPU puts a vertex, against double precision. H2: it moves as the camera does, without jitter.

#include <random>

#include "globe/clipmap/morph.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/render/ground/mesh_probe.h"

namespace {

using globe::planet::Node;
using views::Camera;
using views::dvec3;
using views::MeshProbe;
using views::ProbeVertex;

constexpr double kHalfWidth = 640.0;  ///< of the picture, pixels
constexpr double kHalfHeight = 360.0;
constexpr double kMaxError = 0.1;  ///< pixels
constexpr double kRmsError = 0.02;
constexpr double kNearError = 1e-3;  ///< metres, within
constexpr double kNear = 100.0;      ///< metres
constexpr double kSecondDifference = 0.05;

/// Pixel of a camera-relative point from the middle of a 1280x720 view; nothing outside it.
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

/// Where a node's ground is drawn, ECEF metres in double.
dvec3 drawn_node(const views::Surface& surface, const Node& node) {
  return globe::geo::ecef_from_normal(surface.ellipsoid(), globe::planet::node_direction(node),
                                      std::max(surface.height(node), 0.0));
}

/// The place of a drawn vertex in double, its morph included.
dvec3 exact_place(const views::Surface& surface, const MeshProbe& probe, const ProbeVertex& vertex) {
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

/// A camera above a place, low over the ground drawn there, or as high as asked.
Camera camera_over(const views::Surface& surface, const dvec3& u, double above_m, double heading_deg,
                   double pitch_deg) {
  globe::geo::Geodetic place = globe::geo::degrees_from_normal(u);
  place.h_m = std::max(surface.height(u, 20), 0.0) + above_m;
  return globe::render::make_camera(surface.ellipsoid(), place, heading_deg, pitch_deg, 60.0, 16.0 / 9.0);
}

int finest_for(const MeshProbe& probe, const views::Surface& surface, double above_m) {
  return globe::clipmap::finest_level(probe.settings(), surface.root_edge(), above_m, 26).level;
}

struct Errors {
  double worst_px = 0, sum_px2 = 0, worst_near_m = 0, worst_naive_px = 0;
  std::size_t count = 0, near = 0;
};

void measure(const views::Surface& surface, MeshProbe& probe, const Camera& camera, double above_m,
             std::size_t wanted, Errors& errors) {
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
    const dvec3 truth = place - camera.position;
    const auto true_pixel = pixel(camera, truth);
    if (!true_pixel) continue;
    const double error = glm::length(pixel_of_clip(clip[k].seen) - *true_pixel);
    errors.worst_px = std::max(errors.worst_px, error);
    errors.sum_px2 += error * error;
    ++errors.count;
    if (glm::length(truth) < kNear) {
      errors.worst_near_m = std::max(errors.worst_near_m, glm::length(dvec3(relative[k].seen) - truth));
      ++errors.near;
    }
    const auto naive = pixel(camera, dvec3(glm::vec3(place) - glm::vec3(camera.position)));
    if (naive) errors.worst_naive_px = std::max(errors.worst_naive_px, glm::length(*naive - *true_pixel));
  }
}

TEST_F(GlTest, H1VerticesLieWhereDoublePrecisionPutsThem) {
  const auto surface = views::builtin_planet();
  Errors errors;
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int detail : {16, 64}) {
    MeshProbe probe(surface, globe::clipmap::Settings::for_detail(detail, 0));
    const std::size_t cameras = detail == 64 ? hard::cases(100) : hard::cases(600);
    for (std::size_t k = 0; k < cameras; ++k) {
      const auto& place = views::hard_places()[k / 2 % views::hard_places().size()];
      const dvec3 u = k % 2 == 0 ? hard::random_direction(random)
                                 : globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
      const double above =
          0.1 * std::pow(1e9, (static_cast<double>(k) + unit(random)) / static_cast<double>(cameras));
      const double pitch = above > 1e5 ? -90.0 + 40.0 * unit(random) : -5.0 - 80.0 * unit(random);
      measure(*surface, probe, camera_over(*surface, u, above, 360.0 * unit(random), pitch), above, 2000,
              errors);
    }
  }
  const double rms = std::sqrt(errors.sum_px2 / static_cast<double>(errors.count));
  hard::report("H1", "vertices read back against double, " + std::to_string(errors.count) + ", worst",
               "0.1 px", hard::figure(errors.worst_px) + " px");
  hard::report("H1", "the same, RMS", "0.02 px", hard::figure(rms) + " px");
  hard::report("H1", "within 100 m, " + std::to_string(errors.near) + ", worst", "1 mm",
               hard::figure(errors.worst_near_m * 1e3) + " mm");
  hard::report("H1", "negative control: fp32 coordinates from the planet's centre", "> 0.1 px",
               hard::figure(errors.worst_naive_px) + " px");
  EXPECT_LE(errors.worst_px, kMaxError);
  EXPECT_LE(rms, kRmsError);
  EXPECT_LE(errors.worst_near_m, kNearError);
  EXPECT_GT(errors.near, 1000u);
  EXPECT_GT(errors.worst_naive_px, kMaxError);
}

/// Deviations of one vertex from its exact motion, over three steps.
struct Track {
  std::array<glm::dvec2, 3> off{};

  double second_difference() const { return glm::length(off[2] - 2.0 * off[1] + off[0]); }
};

TEST_F(GlTest, H2AMillimetreOfTheCameraMovesVerticesByThatMuch) {
  const auto surface = views::builtin_planet();
  MeshProbe probe(surface, globe::clipmap::Settings::for_detail(16, 0));
  const std::size_t steps = hard::cases(1000);
  double worst = 0, worst_bend = 0, worst_naive = 0, worst_naive_bend = 0;
  for (const dvec3& u :
       {globe::geo::normal_from_degrees(0.013, 89.983), globe::geo::normal_from_degrees(35.3, 45.1),
        globe::geo::normal_from_degrees(90.0, 0.0)}) {
    Camera camera = camera_over(*surface, u, 1.7, 70.0, -6.0);
    probe.load(camera.position, finest_for(probe, *surface, 1.7));
    const dvec3 step = glm::normalize(camera.forward + 0.4 * camera.right + 0.2 * camera.up) * 1e-3;
    std::vector<std::size_t> tracked;
    std::vector<dvec3> places;
    std::vector<Track> tracks, naive_tracks;
    for (std::size_t n = 0; n < steps; ++n, camera.position += step) {
      const auto clip = probe.triangles(camera, 0.0f, MeshProbe::Space::kClip);
      if (n == 0) {
        for (std::size_t k = 0; k < clip.size(); k += 5) {
          const dvec3 place = exact_place(*surface, probe, clip[k]);
          if (!pixel(camera, place - camera.position)) continue;
          tracked.push_back(k);
          places.push_back(place);
        }
        tracks.resize(tracked.size());
        naive_tracks.resize(tracked.size());
      }
      for (std::size_t t = 0; t < tracked.size(); ++t) {
        const auto truth = pixel(camera, places[t] - camera.position);
        const auto naive = pixel(camera, dvec3(glm::vec3(places[t]) - glm::vec3(camera.position)));
        if (!truth || !naive) continue;  // it left the view
        const auto follow = [&](Track& track, const glm::dvec2& seen, double& deviation, double& bend) {
          track.off = {track.off[1], track.off[2], seen - *truth};
          deviation = std::max(deviation, glm::length(track.off[2]));
          if (n >= 2) bend = std::max(bend, track.second_difference());
        };
        follow(tracks[t], pixel_of_clip(clip[tracked[t]].seen), worst, worst_bend);
        follow(naive_tracks[t], *naive, worst_naive, worst_naive_bend);
      }
    }
    EXPECT_GT(tracked.size(), 500u);
  }
  hard::report("H2",
               "deviation of vertices from exact motion, " + std::to_string(3 * steps) + " steps of 1 mm",
               "0.1 px", hard::figure(worst) + " px");
  hard::report("H2", "second difference of what they deviate", "0.05 px", hard::figure(worst_bend) + " px");
  hard::report("H2", "negative control: fp32 coordinates from the planet's centre", "> 0.1 px",
               hard::figure(worst_naive) + " px, " + hard::figure(worst_naive_bend) + " px");
  EXPECT_LE(worst, kMaxError);
  EXPECT_LE(worst_bend, kSecondDifference);
  EXPECT_GT(worst_naive, kMaxError);
}

}  // namespace
