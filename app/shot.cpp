#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/image_file.h"
#include "app/standing_camera.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/clipmap/ground_below.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/render/camera.h"
#include "globe/render/globe_renderer.h"

namespace app {
namespace {

struct ShotOptions {
  ViewOptions view;
  std::string at;
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

void run(const ShotOptions& options) {
  namespace render = globe::render;
  const ViewOptions& view = options.view;
  const Size size = parse_size(view.size);
  const Look look = view.look.empty() ? Look{0.0, -90.0} : parse_look(view.look);
  const Point at = parse_point(options.at);
  const render::RenderSettings settings = render_settings(view);
  if (!view.overwrite && std::filesystem::exists(view.output)) {
    throw globe::Error(view.output, "the file exists", "give another name or --overwrite");
  }
  const auto surface = open_planet(view);
  const glm::dvec3 sun = sun_for(view, *surface, at.position.lon_deg);

  const globe::gl::Context context(view.device);
  render::GlobeRenderer renderer(surface, settings);
  globe::gl::FramebufferFormat format;
  format.samples = view.samples;
  const globe::gl::Framebuffer target(size.width, size.height, format);

  const globe::geo::Geodetic place =
      standing_place(at, view.agl, surface->ellipsoid(),
                     [&](const glm::dvec3& position) { return renderer.height_above_ground(position); });
  const render::Camera camera =
      render::make_camera(surface->ellipsoid(), place, look.heading_deg, look.pitch_deg, view.fov_deg,
                          static_cast<double>(size.width) / size.height);
  renderer.draw(camera, sun, true, target);
  if (view.show == "depth") {
    write_depth(view, size, target.read_depth(),
                render::near_distance(surface->ellipsoid(),
                                      std::max(renderer.height_above_ground(camera.position),
                                               globe::clipmap::least_above_ground(surface->ellipsoid()))));
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
  command->add_option("--at", options->at, "where the camera stands: LAT,LON[,ALT]")->required();
  command->callback([options] { run(*options); });
}

}  // namespace app
