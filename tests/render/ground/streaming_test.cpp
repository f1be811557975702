// Frames that do not wait: what is drawn is whole however little of the next state is in, whatever the camera
// does, and settles to what a frame that waits shows. Nothing here depends on how fast this machine is: the
// threads that compute are waited for after every frame, and uploads go piece by piece or all at once.

#include <functional>
#include <limits>
#include <random>

#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/render/ground/resident.h"
#include "tests/render/ground/topology.h"

namespace {

using app::accuracy::MeshProbe;
using globe::clipmap::ClipmapState;
using globe::clipmap::Settings;
using globe::clipmap::Stride;
using globe::clipmap::Target;
using globe::gl::Framebuffer;
using globe::render::ClipmapTextures;
using globe::render::FrameStats;
using views::Camera;
using views::dvec3;
using views::GlobeRenderer;
using views::Place;
using views::RenderSettings;

constexpr double kOnePiece = 0.0;  ///< milliseconds of uploads: one small piece a frame
constexpr double kEverything = std::numeric_limits<double>::infinity();

/// Targets of a walk: steps of a few cells, ways across edges, jumps, another sun, another depth.
std::vector<Target> walk(const Place& start, std::size_t moves, int base_level, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Target> targets;
  Target at{globe::geo::normal_from_degrees(start.lat_deg, start.lon_deg),
            base_level + 9,
            {{1.0, 0.0, 0.0}, false}};
  for (std::size_t k = 0; k < moves; ++k) {
    targets.push_back(at);
    const double reach = k % 6 == 5 ? 0.7 : std::exp2(-22.0 * unit(random));
    at.u = glm::normalize(at.u + hard::random_direction(random) * reach);
    if (k % 4 == 3) at.lighting.sun = glm::normalize(at.lighting.sun + dvec3(0.0, 0.3, 0.1));
    at.finest = base_level + 6 + static_cast<int>(random() % 8);
  }
  return targets;
}

struct Disturbed {
  std::size_t texels = 0;  ///< of drawn states, that changed while the next state was loading
  std::size_t looked_at = 0;
  std::size_t pieces = 0;
};

/// Walks from every stride-th of the hard places: texels disturbed between pieces, and once the next state is
/// drawn.
std::pair<Disturbed, Disturbed> disturbed(const Settings& settings, std::size_t stride) {
  const auto surface = views::builtin_planet();
  std::mt19937_64 random(51);
  Disturbed at_piece, at_once;
  for (std::size_t p = 0; p < views::hard_places().size(); p += stride) {
    ClipmapTextures textures(settings);
    std::shared_ptr<const ClipmapState> drawn;
    for (const Target& target :
         walk(views::hard_places()[p], hard::full() ? 30 : 9, settings.base_level, random)) {
      auto update = globe::clipmap::advance(settings, *surface, target, drawn.get(), Stride::kWhole);
      if (!drawn) {
        drawn = update.state;
        textures.apply(std::move(update));
        continue;
      }
      const views::Resident before = views::resident(settings, *drawn, textures);
      textures.begin(std::move(update));
      std::size_t piece = 0;
      const auto jobs = textures.queued_jobs();
      for (; !textures.is_loaded(); ++piece) {
        textures.upload(kOnePiece);
        if (piece % (1 + jobs / 3) != 0 && !textures.is_loaded()) continue;
        at_piece.texels += before.differing(views::resident(settings, *drawn, textures));
        at_piece.looked_at += before.size();
      }
      at_piece.pieces += piece;
      const auto old = std::exchange(drawn, textures.swap());
      // The test bites: of what the old state needs, its successor leaves little in the layers.
      at_once.texels += before.differing(views::resident(settings, *old, textures));
    }
  }
  return {at_piece, at_once};
}

TEST_F(GlTest, WhatIsDrawnStaysUntouchedWhileTheNextStateIsLoading) {
  Settings exact = Settings::for_detail(16, 1), quadratic = exact, hexagon = exact;
  quadratic.positions = globe::clipmap::Positions::kQuadratic;
  hexagon.windows = globe::clipmap::Windows::kHexagon;
  for (const Settings& settings : {exact, quadratic, hexagon}) {
    const bool interpolated = globe::clipmap::is_interpolated(settings.positions);
    const auto [at_piece, at_once] = disturbed(settings, hard::full() ? 1 : interpolated ? 8 : 4);
    const std::string how = ", --positions " + std::string(name_of(settings.positions)) + " --window " +
                            std::string(name_of(settings.windows));
    hard::report("loading",
                 "texels of the drawn state that change while the next one is loading" + how + ", " +
                     std::to_string(at_piece.looked_at) + " looked at between " +
                     std::to_string(at_piece.pieces) + " pieces",
                 "0", std::to_string(at_piece.texels));
    hard::report("loading", "negative control: texels that the next state changes once it is drawn" + how,
                 "> 0", std::to_string(at_once.texels));
    EXPECT_EQ(at_piece.texels, 0u);
    EXPECT_GT(at_once.texels, 0u);
  }
}

TEST_F(GlTest, AStateThatIsAbandonedLeavesNoTrace) {
  const auto surface = views::builtin_planet();
  const Settings settings = Settings::for_detail(16, 1);
  std::mt19937_64 random(52);
  ClipmapTextures textures(settings);
  std::shared_ptr<const ClipmapState> drawn;
  std::size_t different = 0, texels = 0;
  const auto targets = walk(views::hard_places()[8], hard::full() ? 60 : 16, settings.base_level, random);
  for (std::size_t k = 0; k < targets.size(); ++k) {
    auto update = globe::clipmap::advance(settings, *surface, targets[k], drawn.get(), Stride::kWhole);
    if (drawn && k % 3 != 0) {
      textures.begin(std::move(update));
      for (std::size_t piece = 0; piece < 3 * k && !textures.is_loaded(); ++piece) textures.upload(kOnePiece);
      textures.abandon();
      EXPECT_EQ(textures.queued_jobs(), 0u);
      continue;
    }
    drawn = update.state;
    textures.apply(std::move(update));
    auto refill = globe::clipmap::advance(settings, *surface, targets[k], nullptr, Stride::kWhole);
    ClipmapTextures fresh(settings);
    const auto refilled = refill.state;
    fresh.apply(std::move(refill));
    const views::Resident seen = views::resident(settings, *refilled, textures);
    different += seen.differing(views::resident(settings, *refilled, fresh));
    texels += seen.size();
  }
  hard::report(
      "loading",
      "texels that differ from a refill after states were abandoned half-way, " + std::to_string(texels), "0",
      std::to_string(different));
  EXPECT_EQ(different, 0u);
}

TEST_F(GlTest, MemoryOfTheGpuIsBoundedOverAnyJumps) {
  const auto surface = views::builtin_planet();
  const Settings settings = Settings::for_detail(16, 0);
  std::mt19937_64 random(53);
  ClipmapTextures textures(settings);
  std::shared_ptr<const ClipmapState> drawn;
  int most_shares = 0;
  const std::size_t jumps = hard::full() ? 500 : 60;
  for (std::size_t k = 0; k < jumps; ++k) {
    // Half of the jumps to corners, where a level needs layers of all four diamonds.
    const Place& place = views::hard_places()[random() % views::hard_places().size()];
    const dvec3 u = k % 2 == 0 ? hard::random_direction(random)
                               : globe::geo::normal_from_degrees(place.lat_deg + 1e-4, place.lon_deg);
    const Target target{u, settings.base_level + 16, {{1.0, 0.0, 0.0}, false}};
    auto update = globe::clipmap::advance(settings, *surface, target, drawn.get(), Stride::kWhole);
    int shares = 0;
    for (const auto& level : update.state->levels) {
      for (const auto& rect : level->vertices) shares += rect.empty() ? 0 : 1;
    }
    most_shares = std::max(most_shares, shares);
    textures.begin(std::move(update));
    if (k % 5 == 4) {
      textures.upload(kOnePiece);
      textures.abandon();
      continue;
    }
    textures.upload(kEverything);
    drawn = textures.swap();
  }
  // Two states at most, and what growth rounds up to.
  const int bound = 2 * most_shares + 8;
  hard::report("memory",
               "layers of vertices, of shading after " + std::to_string(jumps) + " jumps, " +
                   std::to_string(most_shares) + " needed by one state at most",
               "<= " + std::to_string(bound),
               std::to_string(textures.vertex_layers()) + ", " + std::to_string(textures.shading_layers()));
  EXPECT_LE(textures.vertex_layers(), bound);
  EXPECT_LE(textures.shading_layers(), bound);
}

/// A camera frame by frame, and how many frames it moves.
struct Motion {
  const char* name;
  std::size_t frames;
  std::function<Camera(std::size_t)> camera;
  double sun_turn = 0.0;  ///< radians a frame
};

Camera camera_at(double lat_deg, double lon_deg, double h_m, double heading_deg, double pitch_deg) {
  return globe::render::make_camera(globe::geo::kWgs84, {lat_deg, lon_deg, h_m}, heading_deg, pitch_deg, 60.0,
                                    16.0 / 9.0);
}

std::vector<Motion> motions() {
  constexpr double kPeak = 9100.0;                             ///< metres: above all ground
  constexpr double kOrbitalSpeed = 7800.0 / 30.0 / 111'000.0;  ///< degrees of a meridian a frame
  return {
      {"a jump across the planet", 9,
       [](std::size_t k) {
         return k < 4 ? camera_at(47.0, 8.0, kPeak, 20.0, -30.0)
                      : camera_at(-47.0, -172.0, kPeak, 20.0, -30.0);
       }},
      {"orbital speed at ground level, over an edge of diamonds", 24,
       [](std::size_t k) {
         return camera_at(10.0, kOrbitalSpeed * (static_cast<double>(k) - 12.0), kPeak, 90.0, -10.0);
       }},
      {"orbital speed over a pole", 24,
       [](std::size_t k) {
         const double lat = 90.0 + kOrbitalSpeed * (static_cast<double>(k) - 12.0);
         return lat <= 90.0 ? camera_at(lat, 30.0, kPeak, 0.0, -10.0)
                            : camera_at(180.0 - lat, -150.0, kPeak, 180.0, -10.0);
       }},
      {"a teleport every third frame", 24,
       [](std::size_t k) {
         const Place& place = views::hard_places()[k / 3 * 5 % views::hard_places().size()];
         return camera_at(place.lat_deg, place.lon_deg,
                          kPeak + 10.0 * std::pow(40.0, static_cast<double>(k / 3 % 4)),
                          40.0 * static_cast<double>(k), -40.0);
       }},
      {"a spin", 12,
       [](std::size_t k) { return camera_at(0.01, 89.99, kPeak, 40.0 * static_cast<double>(k), -5.0); }},
      {"a fall from orbit", 16,
       [](std::size_t k) {
         return camera_at(0.0, -90.0, kPeak + 1e7 * std::pow(0.4, static_cast<double>(k)), 0.0, -60.0);
       }},
      {"a rise to orbit", 16,
       [](std::size_t k) {
         return camera_at(35.26, -135.0, kPeak + 10.0 * std::pow(2.5, static_cast<double>(k)), 0.0, -60.0);
       }},
      {"back and forth, 2 km each way", 16,
       [](std::size_t k) { return camera_at(41.3, k % 2 == 0 ? 0.01 : -0.01, kPeak, 0.0, -20.0); }},
      {"the sun racing round a standing camera", 10,
       [](std::size_t) { return camera_at(-35.0, 45.0, kPeak, 0.0, -20.0); }, 0.2},
  };
}

dvec3 sun_of(const Motion& motion, std::size_t frame) {
  const double angle = motion.sun_turn * static_cast<double>(frame);
  return {std::cos(angle), std::sin(angle), 0.0};
}

struct SeenStream {
  std::size_t frames = 0, incomplete = 0, open_edges = 0, not_a_sphere = 0, edges = 0, wrong_vertices = 0;
};

/// Vertices of the levels drawn that are not where the state says.
std::size_t wrong_vertices(const GlobeRenderer& renderer, int finest) {
  std::size_t wrong = 0;
  for (const auto& level : renderer.state().levels) {
    if (level->region.level > finest) continue;
    for (int d = 0; d < globe::planet::kDiamonds; ++d) {
      const auto k = static_cast<std::size_t>(d);
      if (level->vertices[k].empty()) continue;
      const auto texels = views::resident<glm::vec4>(
          renderer.textures().positions(), renderer.clipmap_settings().vertex_torus(), {level->vertices[k]},
          renderer.textures().vertex_layer(level->region.level, d));
      for (std::size_t v = 0; v < texels.size(); ++v) wrong += texels[v] == level->positions[k][v] ? 0 : 1;
    }
  }
  return wrong;
}

TEST_F(GlTest, FastMotionNeverWaitsIsAlwaysClosedAndSettles) {
  const auto surface = views::builtin_planet();
  const Framebuffer picture(160, 90);
  RenderSettings render;
  render.clipmap = Settings::for_detail(16, 0);
  const MeshProbe probe(surface, render.clipmap);
  SeenStream seen;
  std::size_t different_bytes = 0, most_frames = 0;
  for (const Motion& motion : motions()) {
    GlobeRenderer renderer(surface, render);
    renderer.draw(motion.camera(0), sun_of(motion, 0), true, picture);
    for (std::size_t frame = 0; frame < motion.frames; ++frame) {
      const Camera camera = motion.camera(frame);
      const FrameStats stats = renderer.draw(camera, sun_of(motion, frame), false, picture, kOnePiece);
      renderer.await_computing();
      const auto mesh =
          views::topology(probe.triangles(renderer.state(), renderer.textures(), camera, stats.finest_level,
                                          stats.fade, MeshProbe::Space::kRelative));
      seen.open_edges += mesh.open_edges;
      seen.edges += mesh.edges;
      seen.not_a_sphere += mesh.euler == 2 ? 0 : 1;
      seen.wrong_vertices += wrong_vertices(renderer, stats.finest_level);
      seen.incomplete += stats.complete ? 0 : 1;
      if (stats.complete) {
        EXPECT_EQ(stats.completeness, 1.0) << motion.name;
      }
      ++seen.frames;
    }
    // The motion is over: the same camera until nothing is missing.
    const Camera last = motion.camera(motion.frames - 1);
    const dvec3 sun = sun_of(motion, motion.frames - 1);
    std::size_t frames = 0;
    for (FrameStats stats; !stats.complete || frames == 0; ++frames) {
      ASSERT_LT(frames, 400u) << motion.name << " does not settle: " << stats.completeness;
      stats = renderer.draw(last, sun, false, picture, kEverything);
      renderer.await_computing();
    }
    most_frames = std::max(most_frames, frames);
    const auto settled = picture.read_rgba8();
    GlobeRenderer waiting(surface, render);
    waiting.draw(last, sun, true, picture);
    const auto expected = picture.read_rgba8();
    for (std::size_t k = 0; k < settled.size(); ++k) different_bytes += settled[k] == expected[k] ? 0 : 1;
  }
  const std::string of = ", " + std::to_string(motions().size()) + " motions, " +
                         std::to_string(seen.frames) + " frames, " + std::to_string(seen.incomplete) +
                         " of them not complete";
  hard::report("loading",
               "edges not used exactly twice in frames that do not wait, " + std::to_string(seen.edges) + of,
               "0", std::to_string(seen.open_edges));
  hard::report("loading", "drawn vertices that are not where they belong" + of, "0",
               std::to_string(seen.wrong_vertices));
  hard::report("loading", "bytes of settled pictures that differ from ones that waited", "0",
               std::to_string(different_bytes));
  hard::report("loading", "frames that any of these motions takes to settle", "<= 40",
               std::to_string(most_frames));
  EXPECT_EQ(seen.open_edges, 0u);
  EXPECT_EQ(seen.not_a_sphere, 0u);
  EXPECT_EQ(seen.wrong_vertices, 0u);
  EXPECT_GT(seen.incomplete, seen.frames / 10) << "nothing was ever behind";
  EXPECT_EQ(different_bytes, 0u);
  EXPECT_LE(most_frames, 40u);
}

}  // namespace
