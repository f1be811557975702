#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "app/bench.h"
#include "app/frame_budget.h"
#include "app/raw_gl.h"
#include "globe/geo/sun.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/planet/scenic.h"
#include "globe/render/globe_renderer.h"
#include "globe/scene/flight_path.h"

namespace app {
namespace {

namespace render = globe::render;
namespace geo = globe::geo;
using globe::clipmap::Positions;
using globe::clipmap::Settings;

constexpr int kFlightWidth = 1280;
constexpr int kFlightHeight = 720;

/// The built-in planet and a flight over it from 20,000 km to 200 m, one frame a round.
struct World {
  explicit World(int round_count)
      : rounds(round_count),
        surface(globe::planet::Surface::builtin(1)),
        view(globe::planet::scenic_place(*surface)),
        path(geo::normal_from_degrees(view.place.lat_deg, view.place.lon_deg), 2e7,
             geo::normal_from_degrees(view.place.lat_deg, view.place.lon_deg), 200.0, 6.371e6,
             view.heading_deg, 0.0),
        sun(geo::morning_sun(view.place.lon_deg)) {}

  render::Camera camera(int round) const {
    const auto point = path.at(static_cast<double>(round % rounds) / (rounds - 1));
    const geo::Geodetic place{view.place.lat_deg, view.place.lon_deg, point.height_m + view.place.h_m};
    return render::make_camera(surface->ellipsoid(), place, point.heading_deg, point.pitch_deg, 60.0,
                               double(kFlightWidth) / kFlightHeight);
  }

  int rounds;
  globe::gl::Context context;
  std::shared_ptr<const globe::planet::Surface> surface;
  globe::planet::ScenicView view;
  globe::scene::FlightPath path;
  glm::dvec3 sun;
};

/// Draws the flight as in real time: what is there is drawn, what is missing loads meanwhile, within the
/// budget of `globe fly`.
struct FlightRun {
  FlightRun(std::shared_ptr<World> shared, const Settings& settings)
      : world(std::move(shared)),
        renderer(world->surface, ground(settings)),
        target(kFlightWidth, kFlightHeight) {
    renderer.warm_up(target);
    renderer.draw(world->camera(0), world->sun, true, target);
    glFinish();
  }

  static render::RenderSettings ground(const Settings& settings) {
    render::RenderSettings result;
    result.clipmap = settings;
    return result;
  }

  std::size_t draw_next() {
    const auto begin = std::chrono::steady_clock::now();
    const render::FrameStats stats =
        renderer.draw(world->camera(round++), world->sun, false, target, budget.uploads_ms());
    glFinish();
    budget.note(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count(),
                stats.upload_ms);
    return stats.triangles;
  }

  /// The next frame with everything it needs, not measured, so that draw_loaded() has nothing to upload.
  void load_next() { renderer.draw(world->camera(round), world->sun, true, target); }
  void draw_loaded() {
    renderer.draw(world->camera(round++), world->sun, true, target);
    glFinish();
  }

  std::shared_ptr<World> world;
  render::GlobeRenderer renderer;
  globe::gl::Framebuffer target;
  FrameBudget budget{std::nullopt};
  int round = 0;
};

/// A complete frame near the ground, again and again, on so small a picture that what is measured is vertices
/// and our own work.
struct StillRun {
  StillRun(std::shared_ptr<World> shared, const Settings& settings)
      : world(std::move(shared)), renderer(world->surface, FlightRun::ground(settings)), target(64, 36) {
    renderer.warm_up(target);
    draw();
  }

  void draw() {
    renderer.draw(world->camera(world->rounds - 1), world->sun, true, target);
    glFinish();
  }

  std::shared_ptr<World> world;
  render::GlobeRenderer renderer;
  globe::gl::Framebuffer target;
};

/// For every round as many triangles as the flight at detail 64 draws in it, in steps of 4 blocks.
struct RawRun {
  explicit RawRun(std::shared_ptr<World> shared) : world(std::move(shared)) {
    FlightRun flight(world, Settings::for_detail(64));
    for (int k = 0; k < world->rounds; ++k) {
      const std::size_t triangles =
          flight.renderer.draw(world->camera(k), world->sun, true, flight.target).triangles;
      const int rounded = std::max(1, (static_cast<int>(triangles) + 4096) / 8192) * 8192;
      per_round.push_back(rounded);
      if (!raw.contains(rounded))
        raw[rounded] = std::make_unique<RawGl>(
            RawGlLoad{.width = kFlightWidth, .height = kFlightHeight, .triangles_on_screen = rounded});
      (*raw[rounded])();
    }
  }

  void draw_next() {
    glDisable(GL_CULL_FACE);
    (*raw.at(per_round[static_cast<std::size_t>(round++ % world->rounds)]))();
  }

  std::shared_ptr<World> world;
  std::vector<int> per_round;
  std::map<int, std::unique_ptr<RawGl>> raw;
  int round = 0;
};

Benchmark draw_list_benchmark(const std::string& name, const std::shared_ptr<World>& world, int detail) {
  auto flight = std::make_shared<FlightRun>(world, Settings::for_detail(detail));
  const render::Camera camera = world->camera(world->rounds - 1);
  flight->renderer.draw(camera, world->sun, true, flight->target);
  return {name, 1, [flight, camera] {
            const render::GlobeRenderer& renderer = flight->renderer;
            render::make_draw_list(renderer.clipmap_settings(), renderer.state(), renderer.textures(),
                                   flight->world->surface->ellipsoid(), camera,
                                   {renderer.state().target.finest, 0.0f}, true);
          }};
}

}  // namespace

std::vector<BenchmarkEntry> flight_benchmarks(int rounds) {
  const auto shared = std::make_shared<std::shared_ptr<World>>();
  const auto world = [shared, rounds] {
    if (!*shared) *shared = std::make_shared<World>(rounds);
    return *shared;
  };
  std::vector<BenchmarkEntry> entries;
  const auto add = [&](const std::string& name, const Settings& settings) {
    entries.push_back({name, [=] {
                         auto flight = std::make_shared<FlightRun>(world(), settings);
                         const auto settle = [flight] { flight->renderer.await_computing(); };
                         return Benchmark{name, 1, [flight] { flight->draw_next(); }, settle};
                       }});
  };
  for (const int detail : {32, 64, 128})
    add("fly.detail" + std::to_string(detail), Settings::for_detail(detail));
  const auto add_still = [&](const std::string& name, const Settings& settings) {
    entries.push_back({name, [=] {
                         auto still = std::make_shared<StillRun>(world(), settings);
                         return Benchmark{name, 1, [still] { still->draw(); }};
                       }});
  };
  Settings settings = Settings::for_detail(64);
  add_still("draw.vertices", settings);
  for (const Positions positions : {Positions::kQuadratic, Positions::kChord, Positions::kFloat32}) {
    settings.positions = positions;
    add("fly.detail64." + std::string(globe::clipmap::name_of(positions)), settings);
    add_still("draw.vertices." + std::string(globe::clipmap::name_of(positions)), settings);
  }
  settings.positions = Positions::kExact;
  settings.windows = globe::clipmap::Windows::kHexagon;
  add("fly.detail64.hexagon", settings);
  add_still("draw.vertices.hexagon", settings);
  // The same frames with uploads and without any.
  add("fly.uploads", Settings::for_detail(64));
  entries.push_back({"fly.no_uploads", [=] {
                       auto flight = std::make_shared<FlightRun>(world(), Settings::for_detail(64));
                       flight->load_next();
                       return Benchmark{"fly.no_uploads", 1, [flight] { flight->draw_loaded(); },
                                        [flight] { flight->load_next(); }};
                     }});
  // What a frame costs the processor before the driver: the patches in view from eye height.
  for (const int detail : {64, 128}) {
    const std::string name = "render.draw_list.detail" + std::to_string(detail);
    entries.push_back({name, [=] { return draw_list_benchmark(name, world(), detail); }});
  }
  entries.push_back({"fly.raw_gl", [=] {
                       auto raw = std::make_shared<RawRun>(world());
                       return Benchmark{"fly.raw_gl", 1, [raw] { raw->draw_next(); }};
                     }});
  return entries;
}

}  // namespace app
