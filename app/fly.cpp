#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/contact_sheet.h"
#include "app/effect_trace.h"
#include "app/flat_region.h"
#include "app/flight.h"
#include "app/flight_stats.h"
#include "app/frame_budget.h"
#include "app/frame_clock.h"
#include "app/frame_sink.h"
#include "app/parse_options.h"
#include "app/point.h"
#include "app/progress.h"
#include "app/records.h"
#include "app/scene_argument.h"
#include "app/standing_camera.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/timer_query.h"
#include "globe/planet/scenic.h"
#include "globe/render/camera.h"
#include "globe/render/globe_renderer.h"

namespace app {
namespace {

namespace geo = globe::geo;
namespace render = globe::render;

constexpr double kOrbit = 20'000'000.0;  ///< metres above the target
constexpr double kFinalHeight = 200.0;   ///< metres above ground where a flight ends unless --to says more
constexpr double kLongestTurn = 0.1;     ///< seconds that a film with few frames a second waits for each
constexpr double kLongestBudget = 10'000.0;  ///< milliseconds

struct FlyOptions {
  ViewOptions view;
  std::string from = "orbit";
  std::string to;
  int frames = 300;
  double fps = 30.0;
  std::string stats;
  std::string trace;
  std::string contact_sheet;
  bool wait = false;
  std::optional<double> budget_ms;
};

/// An end of the flight: ALT counts from the ellipsoid, or from the ground with --agl; without ALT `fallback`
/// above ground.
FlightEnd end_of(const Point& point, bool agl, double fallback, const render::GlobeRenderer& renderer,
                 const geo::Ellipsoid& ellipsoid) {
  geo::Geodetic place = point.position;
  if (!point.has_alt) return {place, fallback};
  const double above =
      agl ? place.h_m : renderer.height_above_ground(geo::ecef_from_geodetic(ellipsoid, place));
  return {place, std::max(above, least_clearance(ellipsoid))};
}

std::string altitude_text(double metres) {
  char text[32];
  if (metres >= 1e6) {
    std::snprintf(text, sizeof text, "%.0f km", metres / 1e3);
  } else if (metres >= 1e4) {
    std::snprintf(text, sizeof text, "%.1f km", metres / 1e3);
  } else {
    std::snprintf(text, sizeof text, metres < 10.0 ? "%.2g m" : "%.0f m", metres);
  }
  return text;
}

void refuse_existing(const std::string& path, bool overwrite) {
  if (!path.empty() && !overwrite && std::filesystem::exists(path)) {
    throw globe::Error(path, "the file exists", "give another name or --overwrite");
  }
}

/// A flight knows the planet's own ground only: a region's, whose posts are farther apart, may be higher.
void stay_above(geo::Geodetic& place, const render::GlobeRenderer& renderer, const geo::Ellipsoid& ellipsoid,
                bool wait) {
  const double above = renderer.height_above_ground(geo::ecef_from_geodetic(ellipsoid, place), wait);
  place.h_m += std::max(least_clearance(ellipsoid) - above, 0.0);
}

/// A flight, and the place that the sun shines on.
struct Planned {
  Flight flight;
  geo::Geodetic target;
};

/// From --from to --to, or to the scene's camera or a scenic place.
Planned flight_between(const FlyOptions& options, const std::optional<globe::scene::Scene>& scene,
                       const std::shared_ptr<const globe::planet::Surface>& surface,
                       const render::GlobeRenderer& renderer, int max_level) {
  const ViewOptions& view = options.view;
  const geo::Ellipsoid& ellipsoid = surface->ellipsoid();
  const double final_height = kFinalHeight * geo::small_body_scale(ellipsoid);
  Look look = view.look.empty() ? Look{0.0, 0.0} : parse_look(view.look);
  FlightEnd to;
  if (!options.to.empty()) {
    to = end_of(parse_point(options.to), view.agl, final_height, renderer, ellipsoid);
  } else if (scene && scene->camera) {
    to = end_of(scene->camera->at, view.agl || scene->camera->agl, final_height, renderer, ellipsoid);
    if (view.look.empty()) look = look_of(*scene->camera).value_or(look);
  } else {
    const globe::planet::ScenicView scenic = globe::planet::scenic_place(*surface);
    to = {scenic.place, final_height};
    if (view.look.empty()) look.heading_deg = scenic.heading_deg;
  }
  const FlightEnd from =
      options.from == "orbit"
          ? FlightEnd{to.place, kOrbit * ellipsoid.mean_radius() / geo::kWgs84.mean_radius()}
          : end_of(parse_point(options.from), view.agl, final_height, renderer, ellipsoid);
  return {{clipmap_settings(view), surface, max_level, from, to, look}, to.place};
}

void run(FlyOptions options, const CLI::App& command) {
  ViewOptions& view = options.view;
  const std::optional<globe::scene::Scene> scene = take_scene(command, view);
  const Optics optics = optics_of(view.optics);
  const Size size = size_of(view, optics);
  const bool along_path =
      scene && scene->path && options.to.empty() && command.get_option("--from")->count() == 0;
  const bool frames_given = command.get_option("--frames")->count() > 0;
  if (scene && scene->path && scene->path->fps && command.get_option("--fps")->count() == 0)
    options.fps = *scene->path->fps;
  if (along_path && scene->path->frames && !frames_given) options.frames = *scene->path->frames;
  const auto check_frames = [](double frames) {
    if (frames >= 1 && frames <= 1'000'000) return;
    throw globe::UsageError("--frames " + number_text(frames, 0), "not 1 to 1000000",
                            "give a number in that range");
  };
  check_frames(options.frames);
  if (options.budget_ms && !(*options.budget_ms >= 0.0 && *options.budget_ms <= kLongestBudget)) {
    throw globe::UsageError("--budget " + std::to_string(*options.budget_ms), "not 0 to 10000 milliseconds",
                            "give what a frame may take, such as 33");
  }
  const render::RenderSettings settings = render_settings(view);
  if (!view.look.empty()) parse_look(view.look);
  refuse_existing(options.stats, view.overwrite);
  refuse_existing(options.contact_sheet, view.overwrite);
  refuse_existing(options.trace, view.overwrite);
  const auto surface = open_planet(view);
  const geo::Ellipsoid& ellipsoid = surface->ellipsoid();

  const globe::gl::Context context(view.device);
  render::GlobeRenderer renderer(surface, settings, effects_of(scene, *surface, optics),
                                 region_in_globe(region_of(scene, surface, view.quiet), scene, settings));
  Lens lens(optics, size.width, size.height, view.samples, settings.background);
  const globe::gl::Framebuffer& target = lens.target();

  const Planned planned = along_path ? Planned{{settings.clipmap, surface, settings.max_level, *scene->path},
                                               scene->path->keys.back().place}
                                     : flight_between(options, scene, surface, renderer, settings.max_level);
  const Flight& flight = planned.flight;
  if (along_path && !frames_given && !scene->path->frames) {
    const double frames = std::round(flight.duration_s() * options.fps) + 1.0;
    check_frames(frames);
    options.frames = static_cast<int>(frames);
  }
  const Sunlight sun = sun_for(view, *surface, planned.target);
  const double aspect = static_cast<double>(size.width) / size.height;
  const bool look_is_fixed = along_path && !view.look.empty();
  const auto camera_at = [&](const Flight::View& at) {
    return optics.camera(ellipsoid, at.place, look_is_fixed ? parse_look(view.look) : at.look, aspect);
  };

  FrameSink sink({view.output, size.width, size.height, options.fps, view.overwrite});
  std::optional<ContactSheet> sheet;
  if (!options.contact_sheet.empty()) sheet.emplace(options.frames, size.width, size.height);
  FlightStats stats(context.renderer(), context.version(), size.width, size.height, view.detail,
                    surface->data_level());
  EffectTrace trace;
  Progress progress(progress_style(view.quiet || view.output == "-", false));

  lens.warm_up(renderer);
  renderer.set_instant(sun.instant(0.0));
  lens.draw(renderer, camera_at(flight.at(0.0, true)), sun.at(0.0), true);
  globe::gl::TimerQuery timer = globe::gl::TimerQuery::create();
  FrameClock clock(
      std::chrono::duration<double>(options.wait ? 0.0 : std::min(1.0 / options.fps, kLongestTurn)));
  FrameBudget budget(options.budget_ms);
  for (int k = 0; k < options.frames; ++k) {
    clock.await_turn();
    const double t = options.frames == 1 ? 1.0 : static_cast<double>(k) / (options.frames - 1);
    const auto begin = std::chrono::steady_clock::now();
    Flight::View at = flight.at(t, options.wait);
    if (renderer.region() != nullptr) stay_above(at.place, renderer, ellipsoid, options.wait);
    const render::Camera camera = camera_at(at);
    renderer.set_instant(sun.instant(t * flight.duration_s()));
    timer.begin();
    const render::FrameStats frame =
        lens.draw(renderer, camera, sun.at(t * flight.duration_s()), options.wait, budget.uploads_ms());
    target.resolve();
    timer.end();
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    budget.note(took.count(), frame.upload_ms);
    const double above = renderer.height_above_ground(camera.position, options.wait);
    stats.add({k, at.place, above, took.count(), timer.wait_milliseconds(), frame});
    if (!options.trace.empty())
      trace.add({k, t * flight.duration_s(), at.place, above}, renderer.effect_states());
    const std::vector<std::uint8_t> rgba = target.read_rgba8();
    sink.write(rgba);
    if (sheet && sheet->wants(k)) sheet->add(k, rgba, altitude_text(above));
    progress.show("flying", static_cast<double>(k + 1) / options.frames);
  }
  progress.clear();
  sink.finish();
  if (sheet) sheet->write(options.contact_sheet, view.overwrite);
  if (!options.stats.empty()) stats.write(options.stats);
  if (!options.trace.empty()) trace.write(options.trace);
  if (!view.quiet)
    std::fputs(stats.table(renderer.textures().bytes()).c_str(), view.output == "-" ? stderr : stdout);
  if (!context.errors().empty())
    throw globe::Error("OpenGL", context.errors().front(), "try --device software");
}

}  // namespace

void add_fly(CLI::App& program) {
  auto options = std::make_shared<FlyOptions>();
  CLI::App* command = program.add_subcommand("fly", "A flight over a planet, frame by frame");
  add_view_options(*command, options->view);
  command->add_option("--from", options->from, "orbit (20,000 km above the target) or LAT,LON[,ALT]")
      ->capture_default_str();
  command->add_option("--to", options->to,
                      "LAT,LON[,ALT]: the target (default: a scenic place); without ALT 200 m above ground");
  command->add_option("--frames", options->frames,
                      "number of frames (default: 300; along a scene's path as many as its time takes)");
  command->add_option("--fps", options->fps, "frames a second of the film")
      ->capture_default_str()
      ->check(in_range(0.1, 1000.0));
  command->add_option("--stats", options->stats, "JSON file for the figures of every frame");
  command->add_option("--trace", options->trace,
                      "JSON file: when each effect of the scene became active, and why");
  command->add_option("--contact-sheet", options->contact_sheet, "PNG file for twelve frames at a glance");
  command->add_flag(
      "--wait", options->wait,
      "load each frame wholly: deterministic pictures; without it frames are drawn in real time");
  command
      ->add_option("--budget", options->budget_ms,
                   "milliseconds for a frame: uploads take what drawing leaves of them, and at least a "
                   "little (default: a "
                   "third more than drawing takes)")
      ->check(in_range(0.0, 10000.0));
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace app
