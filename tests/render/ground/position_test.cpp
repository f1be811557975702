// H1: where the GPU puts a vertex, against double precision. H2: it moves as the camera does, without jitter.

#include <random>

#include "app/accuracy/position_error.h"
#include "tests/hard/table.h"
#include "tests/render/ground/tour.h"
#include "tests/render/ground/views.h"

namespace {

using app::accuracy::MeshProbe;
using app::accuracy::Sighting;
using views::Camera;
using views::dvec3;

constexpr double kMaxError = 0.1;  ///< pixels
constexpr double kRmsError = 0.02;
constexpr double kNearError = 1e-3;  ///< metres, within
constexpr double kNear = 100.0;      ///< metres
constexpr double kSecondDifference = 0.05;

struct SightingErrors {
  double worst_px = 0, sum_px2 = 0, worst_near_m = 0, worst_naive_px = 0;
  std::size_t count = 0, near = 0;

  void add(const Sighting& sighting) {
    worst_px = std::max(worst_px, sighting.off_px);
    sum_px2 += sighting.off_px * sighting.off_px;
    ++count;
    if (glm::length(sighting.truth) < kNear) {
      worst_near_m = std::max(worst_near_m, sighting.off_m);
      ++near;
    }
    worst_naive_px = std::max(worst_naive_px, sighting.naive_px);
  }
};

TEST_F(GlTest, H1VerticesLieWhereDoublePrecisionPutsThem) {
  const auto surface = views::builtin_planet();
  SightingErrors errors;
  std::mt19937_64 random(10);
  for (const int detail : {16, 64}) {
    MeshProbe probe(surface, globe::clipmap::Settings::for_detail(detail, 0));
    const std::size_t cameras = detail == 64 ? hard::cases(100) : hard::cases(600);
    for (std::size_t k = 0; k < cameras; ++k) {
      const auto [camera, above] = views::tour_stop(*surface, k, cameras, random);
      app::accuracy::see_vertices(*surface, probe, camera, above, 2000,
                                  [&](const Sighting& s) { errors.add(s); });
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
    Camera camera = app::accuracy::camera_over(*surface, u, 1.7, 70.0, -6.0);
    probe.load(camera.position, app::accuracy::finest_for(probe, *surface, 1.7));
    const dvec3 step = glm::normalize(camera.forward + 0.4 * camera.right + 0.2 * camera.up) * 1e-3;
    std::vector<std::size_t> tracked;
    std::vector<dvec3> places;
    std::vector<Track> tracks, naive_tracks;
    for (std::size_t n = 0; n < steps; ++n, camera.position += step) {
      const auto clip = probe.triangles(camera, 0.0f, MeshProbe::Space::kClip);
      if (n == 0) {
        for (std::size_t k = 0; k < clip.size(); k += 5) {
          const dvec3 place = app::accuracy::exact_place(*surface, probe, clip[k]);
          if (!app::accuracy::pixel(camera, place - camera.position)) continue;
          tracked.push_back(k);
          places.push_back(place);
        }
        tracks.resize(tracked.size());
        naive_tracks.resize(tracked.size());
      }
      for (std::size_t t = 0; t < tracked.size(); ++t) {
        const auto truth = app::accuracy::pixel(camera, places[t] - camera.position);
        const auto naive =
            app::accuracy::pixel(camera, dvec3(glm::vec3(places[t]) - glm::vec3(camera.position)));
        if (!truth || !naive) continue;  // it left the view
        const auto follow = [&](Track& track, const glm::dvec2& seen, double& deviation, double& bend) {
          track.off = {track.off[1], track.off[2], seen - *truth};
          deviation = std::max(deviation, glm::length(track.off[2]));
          if (n >= 2) bend = std::max(bend, track.second_difference());
        };
        follow(tracks[t], app::accuracy::pixel_of_clip(clip[tracked[t]].seen), worst, worst_bend);
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
