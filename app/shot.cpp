#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/flat_region.h"
#include "app/save_picture.h"
#include "app/scene_argument.h"
#include "app/standing_camera.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/render/camera.h"
#include "globe/render/globe_renderer.h"

namespace app {
namespace {

struct ShotOptions {
  ViewOptions view;
  StandOptions stand;
};

void run(ShotOptions options, const CLI::App& command) {
  namespace render = globe::render;
  ViewOptions& view = options.view;
  const std::optional<globe::scene::Scene> scene = take_scene(command, view);
  const Optics optics = optics_of(view.optics);
  const Size size = size_of(view, optics);
  if (!view.look.empty()) parse_look(view.look);
  const globe::geo::Geodetic sunny = target_of(options.stand, scene);
  const render::RenderSettings settings = render_settings(view);
  if (!view.overwrite && std::filesystem::exists(view.output)) {
    throw globe::Error(view.output, "the file exists", "give another name or --overwrite");
  }
  const auto surface = open_planet(view);
  const Sunlight sun = sun_for(view, *surface, sunny);

  const globe::gl::Context context(view.device);
  render::GlobeRenderer renderer(surface, settings, effects_of(scene, *surface, optics),
                                 region_in_globe(region_of(scene, surface, view.quiet), scene, settings));
  Lens lens(optics, size.width, size.height, view.samples, settings.background);
  const globe::gl::Framebuffer& target = lens.target();

  const Standpoint stand =
      standpoint(options.stand, view, scene, surface, settings.max_level,
                 [&](const glm::dvec3& position) { return renderer.height_above_ground(position); });
  const render::Camera camera = optics.camera(surface->ellipsoid(), stand.place, stand.look,
                                              static_cast<double>(size.width) / size.height);
  renderer.set_instant(sun.instant(options.stand.moment_s));
  lens.draw(renderer, camera, sun.at(options.stand.moment_s), true);
  save_picture(view, target,
               render::near_distance(surface->ellipsoid(), renderer.nearest_drawn(camera.position)));
  if (!context.errors().empty())
    throw globe::Error("OpenGL", context.errors().front(), "try --device software");
}

}  // namespace

void add_shot(CLI::App& program) {
  auto options = std::make_shared<ShotOptions>();
  CLI::App* command = program.add_subcommand("shot", "One picture of a planet, complete");
  add_view_options(*command, options->view);
  add_stand_options(*command, options->stand);
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace app
