#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/image_file.h"
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

void write_depth(const ViewOptions& options, const Size& size, const std::vector<float>& depth,
                 double near_m) {
  std::vector<float> metres(depth.size());
  std::transform(depth.begin(), depth.end(), metres.begin(), [&](float d) {
    return d > 0.0f ? static_cast<float>(near_m / static_cast<double>(d)) : 0.0f;
  });
  if (options.output.size() > 4 && options.output.ends_with(".exr")) {
    write_image(options.output, size.width, size.height, {"Z"}, metres, options.overwrite);
    return;
  }
  // A picture of depth: nearest white, farthest black, by the logarithm of the distance.
  float nearest = 3e38f;
  float farthest = 0.0f;
  for (const float z : metres) {
    if (z <= 0.0f) continue;
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  const float span = std::max(std::log(std::max(farthest, 1e-6f) / std::max(nearest, 1e-6f)), 1e-6f);
  std::vector<std::uint8_t> rgba(metres.size() * 4, 255);
  for (std::size_t k = 0; k < metres.size(); ++k) {
    const float t = metres[k] > 0.0f ? 1.0f - std::log(metres[k] / nearest) / span : 0.0f;
    std::fill_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * k), 3,
                static_cast<std::uint8_t>(std::clamp(t, 0.0f, 1.0f) * 255.0f));
  }
  write_image(options.output, {size.width, size.height, rgba}, options.overwrite);
}

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
  render::GlobeRenderer renderer(surface, settings, effects_of(scene, *surface, optics));
  Lens lens(optics, size.width, size.height, view.samples, settings.background);
  const globe::gl::Framebuffer& target = lens.target();

  const Standpoint stand =
      standpoint(options.stand, view, scene, surface, settings.max_level,
                 [&](const glm::dvec3& position) { return renderer.height_above_ground(position); });
  const render::Camera camera =
      optics.camera(surface->ellipsoid(), stand.place, stand.look.heading_deg, stand.look.pitch_deg,
                    static_cast<double>(size.width) / size.height);
  renderer.set_instant(sun.instant(options.stand.moment_s));
  lens.draw(renderer, camera, sun.at(options.stand.moment_s), true);
  if (view.show == "depth") {
    write_depth(view, size, target.read_depth(),
                render::near_distance(surface->ellipsoid(), renderer.nearest_drawn(camera.position)));
  } else if (view.output.ends_with(".exr")) {
    const std::vector<float> rgba = target.read_rgba_float();
    write_image(view.output, size.width, size.height, {"R", "G", "B", "A"}, rgba, view.overwrite);
  } else {
    const std::vector<std::uint8_t> rgba = target.read_rgba8();
    write_image(view.output, {size.width, size.height, rgba}, view.overwrite);
  }
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
