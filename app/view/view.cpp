#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "app/scene_argument.h"
#include "app/standing_camera.h"
#include "app/view/globe_scenery.h"
#include "app/view/viewer.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/gl/window.h"

namespace app {
namespace {

namespace geo = globe::geo;

constexpr double kWholeGlobe = 2.4;  ///< radii above ground from which all of it is seen

struct WindowOptions {
  ViewOptions view;
  StandOptions stand;
  view::SessionSettings session;
  std::string overlay = "on";
  std::string folder = ".";
  bool fresh = false;
};

void add_window_options(CLI::App& command, WindowOptions& options) {
  add_stand_options(command, options.stand);
  command.add_option("--features", options.session.features,
                     "database made by globe index: its names can be searched for");
  command.add_option("--folder", options.folder, "where pictures and films are put")->capture_default_str();
  command.add_option("--overlay", options.overlay, "off: without panels at first (Tab brings them)")
      ->capture_default_str()
      ->check(CLI::IsMember({"on", "off"}));
  command.add_flag("--play", options.session.plays, "follow the scene's path at once");
  command.add_flag("--fresh", options.fresh, "begin anew, not as the window was left");
  command
      .add_option("--frames", options.session.frames, "close after so many frames, drawn as fast as can be")
      ->check(CLI::Range(1, 1'000'000));
}

/// Where a window begins that nothing is said of: before the whole globe.
Standpoint whole_globe(const geo::Ellipsoid& ellipsoid) {
  return {{20.0, 10.0, kWholeGlobe * ellipsoid.mean_radius()}, {0.0, -90.0, 0.0}};
}

void show_globe(WindowOptions options, const CLI::App& command) {
  ViewOptions& view = options.view;
  const std::string word = view.planet;
  const std::optional<globe::scene::Scene> scene = take_scene(command, view);
  if (optics_of(view.optics).is_wide())
    throw globe::UsageError("--projection " + view.optics.projection, "a window shows perspective pictures",
                            "leave it out, or take globe shot or globe fly");
  const Size size = size_of(view, {});
  if (!view.look.empty()) parse_look(view.look);
  const globe::render::RenderSettings settings = render_settings(view);
  if (options.session.plays && !(scene && scene->path))
    throw globe::UsageError("--play", "there is no path to follow", "give a scene with a [path]");

  const auto surface = open_planet(view);
  sun_for(view, *surface, {});

  view::SessionSettings& session = options.session;
  session.title = "globe - " + word;
  globe::gl::Window window(session.title + " (loading)", size.width, size.height);
  view::GlobeScenery scenery(word, view, scene, surface);
  session.folder = options.folder;
  session.shows_overlay = options.overlay == "on";
  session.time = view.time;
  session.overhead = view.overhead;
  session.moment_s = options.stand.moment_s;
  if (scene && scene->path)
    session.flight =
        std::make_shared<const Flight>(settings.clipmap, surface, settings.max_level, *scene->path);
  const auto views = view::views_file();
  const bool told = !options.stand.at.empty() || session.plays || options.fresh;
  const std::optional<view::LastView> left =
      told || !views ? std::nullopt : view::recall_view(*views, scenery.name());
  if (left) {
    session.start = left->stand;
    session.moment_s = left->moment_s;
    if (view.time.empty() && view.overhead.empty()) {
      session.time = left->time;
      session.overhead = left->overhead;
    }
    if (!view.look.empty()) session.start.look = parse_look(view.look);
  } else if (!options.stand.at.empty() || (scene && (scene->camera || scene->path))) {
    session.start =
        standpoint(options.stand, view, scene, surface, settings.max_level,
                   [&](const glm::dvec3& at) { return scenery.renderer().height_above_ground(at); });
  } else {
    session.start = whole_globe(surface->ellipsoid());
    if (!view.look.empty()) session.start.look = parse_look(view.look);
  }

  view::Session shown(window, scenery, session);
  view::run_window(shown, session.frames);
  if (views && !session.frames) view::remember_view(*views, scenery.name(), shown.view_now());
  if (!window.errors().empty())
    throw globe::Error("OpenGL", window.errors().front(), "globe shot and globe fly draw without a window");
}

}  // namespace

void add_view(CLI::App& program) {
  auto options = std::make_shared<WindowOptions>();
  CLI::App* command = program.add_subcommand("view", "A window to turn a globe in and fly over it");
  add_drawing_options(*command, options->view);
  add_look_options(*command, options->view);
  add_window_options(*command, *options);
  command->footer(
      "Drag turns the globe, the wheel comes nearer, right drag tilts; the keys are in the overlay (Tab).");
  command->callback([options, command] { show_globe(*options, *command); });
}

}  // namespace app
