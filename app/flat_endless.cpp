#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/flat_endless.h"
#include "app/flight_stats.h"
#include "app/fractal_options.h"
#include "app/frame_sink.h"
#include "app/image_file.h"
#include "app/parse_options.h"
#include "app/progress.h"
#include "app/view_options.h"
#include "flat/fractal/drawer.h"
#include "flat/fractal/low_flight.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/base/text_file.h"
#include "globe/gl/context.h"

namespace app {
namespace {

namespace fractal = globe::flat::fractal;
namespace render = globe::render;

struct EndlessOptions {
  std::string ground = "fractal";
  FractalOptions fractal;
  fractal::PagerSettings pager{.log2_cells = 4, .log2_blocks = 6};
  std::string output;
  std::string size = "1280x720";
  std::string from = "0,0";
  std::string look = "30,-8";
  std::string rings;
  std::string lod = "on", culling = "on";
  std::string stats;
  std::string device = "auto";
  double fov_deg = 60;
  double height_m = 300;
  double speed = 60;
  double fps = 30;
  double sight_m = 12000;
  int frames = 1;
  int samples = 1;
  bool wireframe = false, overwrite = false, quiet = false;
};

glm::dvec2 place_of(const std::string& text) {
  const std::vector<double> numbers = parse_numbers(text, ',');
  constexpr double kFarthest = 1e12;
  if (numbers.size() == 2 && std::abs(numbers[0]) <= kFarthest && std::abs(numbers[1]) <= kFarthest)
    return {numbers[0], numbers[1]};
  throw globe::UsageError("--from " + text, "not metres east and north, within 1e12",
                          "give such as 5000,-200");
}

fractal::TerrainSettings terrain_settings(const EndlessOptions& options) {
  fractal::TerrainSettings settings;
  settings.ground = fractal_settings(options.fractal, options.ground);
  settings.pager = options.pager;
  settings.lod = options.lod == "on";
  settings.culling = options.culling == "on";
  const double block_m = std::ldexp(settings.ground.spacing_m(), options.pager.log2_cells);
  const double blocks = std::ldexp(1.0, options.pager.log2_blocks);
  settings.rings = {0.16 * blocks, 0.32 * blocks};
  if (!options.rings.empty()) {
    const std::vector<double> radii = parse_numbers(options.rings, ',');
    if (radii.size() != 2)
      throw globe::UsageError("--rings " + options.rings, "not two radii", "give metres such as 2500,5000");
    settings.rings = {radii[0] / block_m, radii[1] / block_m};
  } else {
    settings.rings.medium = std::max(settings.rings.medium, settings.rings.fine + 1.5);
  }
  return settings;
}

/// Figures of the frames, as they are summed up at the end and written to --stats.
class EndlessStats {
 public:
  void add(const glm::dvec3& eye_m, double frame_ms, const fractal::Drawer::Stats& drawn) {
    times_.push_back(frame_ms);
    triangles_ += static_cast<double>(drawn.triangles);
    frames_.push_back({{"frame", frames_.size()},
                       {"east_m", eye_m.x},
                       {"north_m", eye_m.y},
                       {"height_m", eye_m.z},
                       {"frame_ms", frame_ms},
                       {"triangles", drawn.triangles},
                       {"blocks", drawn.blocks},
                       {"upload_bytes", drawn.upload_bytes},
                       {"boxes_tested", drawn.culling.boxes},
                       {"planes_tested", drawn.culling.planes}});
  }

  nlohmann::json summary(const fractal::Pager::Counts& counts) const {
    const auto count = static_cast<double>(times_.size());
    double sum = 0;
    for (const double ms : times_) sum += ms;
    return {{"frames", times_.size()},          {"mean_triangles", triangles_ / count},
            {"mean_fps", 1000.0 * count / sum}, {"median_ms", percentile(times_, 50)},
            {"p99_ms", percentile(times_, 99)}, {"pagings", counts.moves},
            {"blocks_made", counts.blocks},     {"area_hits", counts.hits},
            {"area_misses", counts.misses}};
  }

  std::string json(const std::string& renderer, const nlohmann::json& summary) const {
    return nlohmann::json{{"renderer", renderer}, {"frames", frames_}, {"summary", summary}}.dump(1) + "\n";
  }

 private:
  std::vector<double> times_;
  double triangles_ = 0;
  nlohmann::json frames_ = nlohmann::json::array();
};

bool is_picture(const EndlessOptions& options) {
  return options.output.ends_with(".png") && options.output.find_first_of("#%") == std::string::npos;
}

void run(const EndlessOptions& options) {
  const Size size = parse_size(options.size);
  const Look look = parse_look(options.look);
  const glm::dvec2 from = place_of(options.from);
  const bool picture = is_picture(options);
  if (picture && options.frames > 1)
    throw globe::UsageError("-o " + options.output, "holds one frame", "give film.mp4 or frames/####.png");
  for (const std::string& path : {options.output, options.stats}) {
    if (!path.empty() && path != "-") globe::refuse_existing(path, options.overwrite);
  }
  const fractal::TerrainSettings settings = terrain_settings(options);
  const double length_m = options.frames / options.fps * options.speed;
  const double farthest_posts =
      (std::max(std::abs(from.x), std::abs(from.y)) + length_m) / settings.ground.spacing_m();
  if (farthest_posts > 0x1p50) {
    throw globe::UsageError("--from " + options.from,
                            "the flight goes beyond 2^50 posts, where places are inexact",
                            "start nearer, or have a larger --area or fewer --iterations");
  }
  fractal::Terrain terrain(settings);
  const fractal::LowFlight flight(terrain.pager().ground(), {.from_m = from,
                                                             .heading_deg = look.heading_deg,
                                                             .length_m = length_m,
                                                             .clearance_m = options.height_m});
  const render::Camera camera = fractal::flat_camera(look.heading_deg, look.pitch_deg, options.fov_deg,
                                                     static_cast<double>(size.width) / size.height);

  const globe::gl::Context context(options.device);
  const globe::gl::Framebuffer target(size.width, size.height, {.samples = options.samples});
  fractal::Drawer drawer(terrain, {.sight_m = options.sight_m, .wireframe = options.wireframe});
  std::unique_ptr<FrameSink> sink;
  if (!picture)
    sink = std::make_unique<FrameSink>(
        FrameOutput{options.output, size.width, size.height, options.fps, options.overwrite});
  const double near_m = std::min(1.0, 0.25 * options.height_m);
  drawer.draw(camera, flight.at(0.0), near_m, target);
  glFinish();
  EndlessStats stats;
  Progress progress(progress_style(options.quiet || options.output == "-", false));
  for (int k = 0; k < options.frames; ++k) {
    const glm::dvec3 eye =
        flight.at(options.frames == 1 ? 0.0 : static_cast<double>(k) / (options.frames - 1));
    const auto begin = std::chrono::steady_clock::now();
    const fractal::Drawer::Stats drawn = drawer.draw(camera, eye, near_m, target);
    target.resolve();
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    stats.add({eye.x * terrain.spacing_m(), eye.y * terrain.spacing_m(), eye.z}, took.count(), drawn);
    const std::vector<std::uint8_t> rgba = target.read_rgba8();
    if (sink) {
      sink->write(rgba);
    } else {
      write_image(options.output, {size.width, size.height, rgba}, options.overwrite);
    }
    progress.show("flying", static_cast<double>(k + 1) / options.frames);
  }
  progress.clear();
  if (sink) sink->finish();
  if (!context.errors().empty())
    throw globe::Error("OpenGL", context.errors().front(), "try --device software");
  const nlohmann::json summary = stats.summary(terrain.pager().counts());
  if (!options.stats.empty())
    globe::write_text_file(options.stats, stats.json(context.renderer(), summary), options.overwrite);
  if (!options.quiet) {
    std::fprintf(stderr, "%s: %.0f triangles, %.1f frames a second (means); %llu pagings, %llu blocks made\n",
                 context.renderer().c_str(), summary["mean_triangles"].get<double>(),
                 summary["mean_fps"].get<double>(), summary["pagings"].get<unsigned long long>(),
                 summary["blocks_made"].get<unsigned long long>());
  }
}

}  // namespace

void add_flat_endless(CLI::App& flat) {
  auto options = std::make_shared<EndlessOptions>();
  CLI::App* command =
      flat.add_subcommand("endless", "A low flight over fractal ground without end, which lies flat");
  command->add_option("GROUND", options->ground, "fractal[:SEED]")->capture_default_str();
  command
      ->add_option("-o,--output", options->output, "x.png, film.mp4, film.gif, frames/####.png, or - (Y4M)")
      ->required();
  command->add_option("--from", options->from, "EAST,NORTH, metres")->capture_default_str();
  command->add_option("--look", options->look, "HEADING,PITCH, degrees; the flight goes along the heading")
      ->capture_default_str();
  const auto number = [&](const char* name, auto& value, double low, double high, const char* help) {
    command->add_option(name, value, help)->capture_default_str()->check(in_range(low, high));
  };
  const auto on_off = [&](const char* name, std::string& value, const char* help) {
    command->add_option(name, value, help)->capture_default_str()->check(CLI::IsMember({"on", "off"}));
  };
  number("--height", options->height_m, 1, 1e5, "least height above the ground, metres");
  number("--speed", options->speed, 0, 1e6, "metres a second");
  number("--frames", options->frames, 1, 1'000'000, "number of frames");
  number("--fps", options->fps, 1e-3, 1000, "frames a second of the film");
  number("--fov", options->fov_deg, 0.1, 170, "vertical field of view, degrees");
  number("--sight", options->sight_m, 0, 1e9, "metres at which fog leaves 1/e of the ground; 0: no fog");
  command->add_option("--size", options->size, "WxH")->capture_default_str();
  command->add_option("--samples", options->samples, "a pixel has")
      ->capture_default_str()
      ->check(CLI::IsMember({1, 4}));
  on_off("--lod", options->lod, "off: every post is drawn");
  on_off("--culling", options->culling, "off: blocks out of view are drawn too");
  command->add_option(
      "--rings", options->rings,
      "radii of the finest level and of the next, metres (default: 0.16 and 0.32 of what is there); a level "
      "goes over into the next gradually where there are two blocks of it, and three between the radii");
  number("--block", options->pager.log2_cells, 2, 6, "a block's side has 2^N cells");
  number("--blocks", options->pager.log2_blocks, 2, 8, "what is there has 2^N blocks a side");
  number("--slack", options->pager.slack, 0, 1, "how much wider than a block the box is that pages, blocks");
  number("--cached-areas", options->pager.cached_areas, 0, 4096, "areas kept for their return");
  add_fractal_options(*command, options->fractal);
  command->add_flag("--wireframe", options->wireframe, "only the triangles' edges");
  command->add_option("--stats", options->stats, "JSON file of figures, frame by frame");
  command->add_flag("--overwrite", options->overwrite, "replace what is there");
  command->add_flag("--quiet", options->quiet, "no progress, no figures");
  command->add_option("--device", options->device, "auto, software or a number")->capture_default_str();
  command->footer("Example: globe flat endless fractal:7 -o film.mp4 --frames 300");
  command->callback([options] { run(*options); });
}

}  // namespace app
