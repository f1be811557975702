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
#include "app/flight.h"
#include "app/flight_stats.h"
#include "app/frame_budget.h"
#include "app/frame_clock.h"
#include "app/frame_sink.h"
#include "app/parse_options.h"
#include "app/point.h"
#include "app/progress.h"
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
  std::string contact_sheet;
  bool wait = false;
  std::optional<double> budget_ms;
};

/// An end of the flight: ALT counts from the ellipsoid, or from the ground with --agl; without ALT `fallback`
/// above ground.
FlightEnd parse_end(const std::string& text, bool agl, double fallback, const render::GlobeRenderer& renderer,
                    const geo::Ellipsoid& ellipsoid) {
  const Point point = parse_point(text);
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

void run(const FlyOptions& options) {
  const ViewOptions& view = options.view;
  const Size size = parse_size(view.size);
  if (options.frames < 1 || options.frames > 1'000'000) {
    throw globe::UsageError("--frames " + std::to_string(options.frames), "not 1 to 1000000",
                            "give a number in that range");
  }
  if (options.budget_ms && !(*options.budget_ms >= 0.0 && *options.budget_ms <= kLongestBudget)) {
    throw globe::UsageError("--budget " + std::to_string(*options.budget_ms), "not 0 to 10000 milliseconds",
                            "give what a frame may take, such as 33");
  }
  const render::RenderSettings settings = render_settings(view);
  refuse_existing(options.stats, view.overwrite);
  refuse_existing(options.contact_sheet, view.overwrite);
  const auto surface = open_planet(view);
  const geo::Ellipsoid& ellipsoid = surface->ellipsoid();

  const globe::gl::Context context(view.device);
  render::GlobeRenderer renderer(surface, settings);
  globe::gl::FramebufferFormat format;
  format.samples = view.samples;
  const globe::gl::Framebuffer target(size.width, size.height, format);

  const double final_height = kFinalHeight * geo::small_body_scale(ellipsoid);
  Look look = view.look.empty() ? Look{0.0, 0.0} : parse_look(view.look);
  FlightEnd to;
  if (options.to.empty()) {
    const globe::planet::ScenicView scenic = globe::planet::scenic_place(*surface);
    to = {scenic.place, final_height};
    if (view.look.empty()) look.heading_deg = scenic.heading_deg;
  } else {
    to = parse_end(options.to, view.agl, final_height, renderer, ellipsoid);
  }
  const FlightEnd from =
      options.from == "orbit"
          ? FlightEnd{to.place, kOrbit * ellipsoid.mean_radius() / geo::kWgs84.mean_radius()}
          : parse_end(options.from, view.agl, final_height, renderer, ellipsoid);
  const glm::dvec3 sun = sun_for(view, *surface, to.place.lon_deg);
  const Flight flight(settings.clipmap, surface, settings.max_level, from, to, look.heading_deg,
                      look.pitch_deg);
  const double aspect = static_cast<double>(size.width) / size.height;
  const auto camera_at = [&](const Flight::View& at) {
    return render::make_camera(ellipsoid, at.place, at.heading_deg, at.pitch_deg, view.fov_deg, aspect);
  };

  FrameSink sink({view.output, size.width, size.height, options.fps, view.overwrite});
  std::optional<ContactSheet> sheet;
  if (!options.contact_sheet.empty()) sheet.emplace(options.frames, size.width, size.height);
  FlightStats stats(context.renderer(), context.version(), size.width, size.height, view.detail,
                    surface->data_level());
  Progress progress(progress_style(view.quiet || view.output == "-", false));

  renderer.warm_up(target);
  renderer.draw(camera_at(flight.at(0.0, true)), sun, true, target);
  globe::gl::TimerQuery timer = globe::gl::TimerQuery::create();
  FrameClock clock(
      std::chrono::duration<double>(options.wait ? 0.0 : std::min(1.0 / options.fps, kLongestTurn)));
  FrameBudget budget(options.budget_ms);
  for (int k = 0; k < options.frames; ++k) {
    clock.await_turn();
    const double t = options.frames == 1 ? 1.0 : static_cast<double>(k) / (options.frames - 1);
    const auto begin = std::chrono::steady_clock::now();
    const Flight::View at = flight.at(t, options.wait);
    const render::Camera camera = camera_at(at);
    timer.begin();
    const render::FrameStats frame = renderer.draw(camera, sun, options.wait, target, budget.uploads_ms());
    target.resolve();
    timer.end();
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    budget.note(took.count(), frame.upload_ms);
    const double above = renderer.height_above_ground(camera.position, options.wait);
    stats.add({k, at.place, above, took.count(), timer.wait_milliseconds(), frame});
    const std::vector<std::uint8_t> rgba = target.read_rgba8();
    sink.write(rgba);
    if (sheet && sheet->wants(k)) sheet->add(k, rgba, altitude_text(above));
    progress.show("flying", static_cast<double>(k + 1) / options.frames);
  }
  progress.clear();
  sink.finish();
  if (sheet) sheet->write(options.contact_sheet, view.overwrite);
  if (!options.stats.empty()) stats.write(options.stats);
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
  command->add_option("--frames", options->frames, "number of frames")->capture_default_str();
  command->add_option("--fps", options->fps, "frames a second of the film")
      ->capture_default_str()
      ->check(in_range(0.1, 1000.0));
  command->add_option("--stats", options->stats, "JSON file for the figures of every frame");
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
  command->callback([options] { run(*options); });
}

}  // namespace app
