#include <filesystem>
#include <future>
#include <memory>

#include "app/commands.h"
#include "app/flat_camera.h"
#include "app/flat_options.h"
#include "app/planet_argument.h"
#include "app/scene_argument.h"
#include "app/standing_camera.h"
#include "app/view/flat_scenery.h"
#include "app/view/globe_scenery.h"
#include "app/view/window_options.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/clipmap/stream.h"
#include "globe/gl/window.h"

namespace app {
namespace {

namespace geo = globe::geo;

constexpr double kWholeGlobe = 2.4;  ///< radii above ground from which all of it is seen

struct GlobeOptions {
  ViewOptions view;
  StandOptions stand;
  view::WindowOptions window;
};

struct RegionOptions {
  FlatOptions flat;
  view::WindowOptions window;
};

/// Where a window begins that nothing is said of: before the whole globe.
Standpoint whole_globe(const geo::Ellipsoid& ellipsoid) {
  return {{20.0, 10.0, kWholeGlobe * ellipsoid.mean_radius()}, {0.0, -90.0, 0.0}};
}

void require_perspective(const ViewOptions& options) {
  if (optics_of(options.optics).is_wide())
    throw globe::UsageError("--projection " + options.optics.projection,
                            "a window shows perspective pictures",
                            "leave it out, or take globe shot or globe fly");
}

void show_globe(GlobeOptions options, const CLI::App& command) {
  ViewOptions& view = options.view;
  const std::string word = view.planet;
  const std::optional<globe::scene::Scene> scene = take_scene(command, view);
  require_perspective(view);
  const Size size = size_of(view, {});
  if (!view.look.empty()) parse_look(view.look);
  const globe::render::RenderSettings settings = render_settings(view);
  if (options.window.plays && !(scene && scene->path))
    throw globe::UsageError("--play", "there is no path to follow", "give a scene with a [path]");
  view.sea_floor = globe::planet::SeaFloor::kFlooded;  // of the first picture; the sea comes with the effects
  const auto surface = open_planet(view);
  sun_for(view, *surface, {});

  view::SessionSettings session = view::session_settings(options.window, view, word);
  const auto ground =
      std::async(std::launch::async, [&] { globe::clipmap::make_base_ground(settings.clipmap, *surface); });
  globe::gl::Window window(session.title + " (loading)", size.width, size.height);
  view::GlobeScenery scenery(word, view, scene, surface);
  session.moment_s = options.stand.moment_s;
  if (scene && scene->path)
    session.flight =
        std::make_shared<const Flight>(settings.clipmap, surface, settings.max_level, *scene->path);
  const auto left = view::left_view(options.window, scenery.name());
  if (left && options.stand.at.empty()) {
    view::take_left_view(*left, session);
    if (!view.look.empty()) session.start.look = parse_look(view.look);
  } else if (!options.stand.at.empty() || (scene && (scene->camera || scene->path))) {
    session.start =
        standpoint(options.stand, view, scene, surface, settings.max_level,
                   [&](const glm::dvec3& at) { return scenery.renderer().height_above_ground(at); });
  } else {
    session.start = whole_globe(surface->ellipsoid());
    if (!view.look.empty()) session.start.look = parse_look(view.look);
  }
  ground.wait();
  view::run_session(options.window, window, scenery, session);
}

/// The word for the region, and what was said of which part of it.
std::vector<std::string> region_words(const std::string& word, const CLI::App& command) {
  std::vector<std::string> words{word};
  for (const char* name : {"--center", "--side", "--spacing", "--iterations", "--roughness", "--relief",
                           "--area", "--base", "--contrast", "--method"}) {
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option != nullptr && option->count() > 0)
      words.insert(words.end(), {name, option->results().front()});
  }
  return words;
}

void show_region(RegionOptions options, const CLI::App& command) {
  FlatOptions& flat = options.flat;
  const std::string word = flat.planet;
  const std::optional<globe::scene::Scene> scene = take_flat_scene(command, flat);
  check_options(flat);
  require_perspective(flat);
  const Size size = size_of(flat, {});
  const Start start = start_of(flat, scene);
  FlatRegion region = open_region(flat, flat.region, place_of(start));
  const auto terrain = region.terrain;
  sun_for(flat, region.body, terrain->frame().origin());

  view::SessionSettings session = view::session_settings(options.window, flat, word);
  globe::gl::Window window(session.title + " (loading)", size.width, size.height);
  view::FlatScenery scenery(region_words(word, command), flat, std::move(region));
  const auto left = view::left_view(options.window, scenery.name());
  if (left && flat.at.empty()) {
    view::take_left_view(*left, session);
  } else if (start.at) {
    session.start = {
        standing_place(*start.at, start.agl, scenery.ellipsoid(),
                       [&](const glm::dvec3& at) { return scenery.renderer().height_above_ground(at); }),
        start.look.value_or(Look{0.0, -90.0, 0.0})};
  } else {
    const FlatView whole = overview(*terrain);
    session.start = {whole.place, whole.look};
  }
  if (!flat.look.empty()) session.start.look = parse_look(flat.look);
  view::run_session(options.window, window, scenery, session);
}

/// A height map of a place, or fractal ground: what `globe flat` shows and a globe does not.
bool is_local(const std::string& word) {
  return fractal_seed(word) ||
         (!word.ends_with(".toml") && !procedural_seed(word) && std::filesystem::is_regular_file(word));
}

}  // namespace

void add_view(CLI::App& program) {
  auto options = std::make_shared<GlobeOptions>();
  CLI::App* command = program.add_subcommand(
      "view", "A window to turn a globe in and fly over it, or over a height map of a place");
  add_drawing_options(*command, options->view);
  add_look_options(*command, options->view);
  add_stand_options(*command, options->stand);
  view::add_window_options(*command, options->window);
  command->add_flag("--play", options->window.plays, "follow the scene's path at once");
  command->callback([options, command] {
    if (!is_local(options->view.planet)) return show_globe(*options, *command);
    RegionOptions region;
    static_cast<ViewOptions&>(region.flat) = options->view;
    region.flat.at = options->stand.at;
    region.window = options->window;
    show_region(region, *command);
  });
}

void add_flat_view(CLI::App& flat) {
  auto options = std::make_shared<RegionOptions>();
  CLI::App* command = flat.add_subcommand("view", "A window to look at a region in");
  add_flat_options(*command, options->flat);
  add_look_options(*command, options->flat);
  command->add_option("--at", options->flat.at,
                      "where the camera stands at first: LAT,LON[,ALT] (default: where all of it is seen)");
  view::add_window_options(*command, options->window);
  command->callback([options, command] { show_region(*options, *command); });
}

}  // namespace app
