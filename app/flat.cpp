#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/flat_camera.h"
#include "app/flat_endless.h"
#include "app/flat_options.h"
#include "app/flight_stats.h"
#include "app/frame_sink.h"
#include "app/parse_options.h"
#include "app/progress.h"
#include "app/save_picture.h"
#include "app/view_options.h"
#include "flat/geomipmap_renderer.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/gl/context.h"
#include "globe/gl/timer_query.h"

namespace app {
namespace {

namespace flat = globe::flat;
namespace geo = globe::geo;
namespace render = globe::render;

struct FilmOptions : FlatOptions {
  std::string to;
  int frames = 300;
  double fps = 30.0;
  std::string stats;
};

/// A region, what draws it, and through what.
struct Stage {
  FlatRegion region;
  Optics optics;
  Size size;
  Sunlight sun;
  globe::gl::Context context;
  flat::GeomipmapRenderer renderer;
  Lens lens;

  Stage(const FlatOptions& options, const std::optional<geo::Geodetic>& around)
      : region(open_region(options, options.region, around)),
        optics(optics_of(options.optics)),
        size(size_of(options, optics)),
        sun(sun_for(options, region.body, around.value_or(region.terrain->frame().origin()))),
        context(options.device),
        renderer(region.terrain, flat::post_colors(*region.terrain, region.knowledge),
                 geomipmap_settings(options, region)),
        lens(optics, size.width, size.height, options.samples, background_of(options)) {}

  const geo::Ellipsoid& ellipsoid() const { return region.terrain->frame().ellipsoid(); }

  render::Camera camera(const FlatView& view) const {
    return optics.camera(ellipsoid(), view.place, view.look, static_cast<double>(size.width) / size.height);
  }

  geo::Geodetic stand_at(const Point& point, bool agl) const {
    return standing_place(point, agl, ellipsoid(),
                          [&](const glm::dvec3& at) { return renderer.height_above_ground(at); });
  }

  void check() const {
    if (!context.errors().empty())
      throw globe::Error("OpenGL", context.errors().front(), "try --device software");
  }
};

FlatView view_of(const Stage& stage, const Start& start, const FlatOptions& options) {
  FlatView view = overview(*stage.region.terrain);
  if (start.at) view = {stage.stand_at(*start.at, start.agl), start.look.value_or(Look{0.0, -90.0})};
  if (!options.look.empty()) view.look = parse_look(options.look);
  return view;
}

void take_shot(FlatOptions options, const CLI::App& command) {
  const std::optional<globe::scene::Scene> scene = take_flat_scene(command, options);
  check_options(options);
  globe::refuse_existing(options.output, options.overwrite);
  const Start start = start_of(options, scene);
  Stage stage(options, place_of(start));
  const render::Camera camera = stage.camera(view_of(stage, start, options));
  stage.renderer.set_instant({options.moment_s});
  const render::FrameStats drawn = stage.lens.draw(stage.renderer, camera, stage.sun.at(0.0), true);
  save_picture(options, stage.lens.target(),
               render::near_distance(stage.ellipsoid(), stage.renderer.nearest_drawn(camera.position)));
  if (!options.quiet)
    std::fprintf(stderr, "%zu triangles in %zu of %zu patches\n", drawn.triangles, drawn.patches,
                 stage.region.terrain->patch_count());
  stage.check();
}

constexpr double kFilmed = 200.0;  ///< metres above ground of a film's ends that have no ALT

Point above_ground(Point point) {
  if (!point.has_alt) point.position.h_m = kFilmed;
  return point;
}

/// Where a film ends: --to, or 200 m over the region's middle.
FlatView end_of(const Stage& stage, const FilmOptions& options) {
  const flat::TangentFrame& frame = stage.region.terrain->frame();
  FlatView view{frame.origin(), {0.0, -5.0}};
  view.place.h_m = frame.geodetic_from_local({0.0, 0.0, stage.region.terrain->z_at(0.0, 0.0)}).h_m + kFilmed;
  if (!options.to.empty()) {
    const Point to = above_ground(parse_point(options.to));
    view.place = stage.stand_at(to, options.agl || !to.has_alt);
  }
  if (!options.look.empty()) view.look = parse_look(options.look);
  return view;
}

void film(FilmOptions options, const CLI::App& command) {
  const std::optional<globe::scene::Scene> scene = take_flat_scene(command, options);
  check_options(options);
  if (!options.stats.empty()) globe::refuse_existing(options.stats, options.overwrite);
  if (options.frames < 1 || options.frames > 1'000'000)
    throw globe::UsageError("--frames", "not 1 to 1000000", "give a number in that range");
  Start start = start_of(options, scene);
  if (start.at && !start.at->has_alt) start = {above_ground(*start.at), true, start.look};
  Stage stage(options, place_of(start));
  const FlatFlight flight(*stage.region.terrain, view_of(stage, start, options), end_of(stage, options));

  FrameSink sink({options.output, stage.size.width, stage.size.height, options.fps, options.overwrite});
  FlightStats stats(stage.context.renderer(), stage.context.version(), stage.size.width, stage.size.height,
                    flat::kPatchCells, 0);
  Progress progress(progress_style(options.quiet || options.output == "-", false));
  stage.lens.draw(stage.renderer, stage.camera(flight.at(0.0)), stage.sun.at(0.0), true);
  globe::gl::TimerQuery timer = globe::gl::TimerQuery::create();
  for (int k = 0; k < options.frames; ++k) {
    const double t = options.frames == 1 ? 1.0 : static_cast<double>(k) / (options.frames - 1);
    const auto begin = std::chrono::steady_clock::now();
    const FlatView view = flight.at(t);
    const render::Camera camera = stage.camera(view);
    stage.renderer.set_instant({k / options.fps});
    timer.begin();
    const render::FrameStats frame = stage.lens.draw(stage.renderer, camera, stage.sun.at(0.0), true);
    stage.lens.target().resolve();
    timer.end();
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    stats.add({k, view.place, stage.renderer.height_above_ground(camera.position), took.count(),
               timer.wait_milliseconds(), frame});
    sink.write(stage.lens.target().read_rgba8());
    progress.show("flying", static_cast<double>(k + 1) / options.frames);
  }
  progress.clear();
  sink.finish();
  if (!options.stats.empty()) stats.write(options.stats);
  if (!options.quiet)
    std::fputs(stats.table(stage.renderer.frame_stats().gpu_bytes).c_str(),
               options.output == "-" ? stderr : stdout);
  stage.check();
}

struct PvsOptions : ViewOptions {
  LocalRegionOptions region;
};

void write_pvs(const PvsOptions& options) {
  globe::refuse_existing(options.output, options.overwrite);
  const FlatRegion region = open_region(options, options.region, std::nullopt);
  Progress progress(progress_style(options.quiet, false));
  const flat::Visibility sets = flat::Visibility::compute(
      *region.terrain, [&](double share) { progress.show("looking around", share); });
  progress.clear();
  sets.write(options.output, options.overwrite);
  if (!options.quiet)
    std::printf("%zu patches, %d layers, %zu KiB; %.1f %% of the pairs of cells and patches are hidden\n",
                region.terrain->patch_count(), flat::Visibility::kLayers, sets.bytes() / 1024,
                100.0 * sets.hidden_share());
}

}  // namespace

void add_flat(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("flat", "A local region: a height map of a place, or a part of a planet");
  command->require_subcommand(1);
  add_flat_endless(*command);

  auto shot = std::make_shared<FlatOptions>();
  CLI::App* shot_command = command->add_subcommand("shot", "One picture of a region");
  add_flat_options(*shot_command, *shot);
  add_output_options(*shot_command, *shot);
  shot_command->add_option("--at", shot->at,
                           "where the camera stands: LAT,LON[,ALT] (default: where all of it is seen)");
  shot_command->add_option("--moment", shot->moment_s, "seconds that the clouds have moved for")
      ->capture_default_str()
      ->check(in_range(0.0, 1e9));
  shot_command->footer("Example: globe flat shot st_helens.dem -o helens.png --wireframe");
  shot_command->callback([shot, shot_command] { take_shot(*shot, *shot_command); });

  auto fly = std::make_shared<FilmOptions>();
  CLI::App* fly_command = command->add_subcommand("fly", "A flight over a region, frame by frame");
  add_flat_options(*fly_command, *fly);
  add_output_options(*fly_command, *fly);
  fly_command->add_option("--from", fly->at, "LAT,LON[,ALT] (default: where all of it is seen)");
  fly_command->add_option("--to", fly->to,
                          "LAT,LON[,ALT] (default: its middle); without ALT 200 m above ground");
  fly_command->add_option("--frames", fly->frames, "number of frames")->capture_default_str();
  fly_command->add_option("--fps", fly->fps, "frames a second of the film")
      ->capture_default_str()
      ->check(in_range(1e-3, 1000.0));
  fly_command->add_option("--stats", fly->stats, "JSON file of figures, frame by frame");
  fly_command->callback([fly, fly_command] { film(*fly, *fly_command); });

  add_flat_view(*command);

  auto pvs = std::make_shared<PvsOptions>();
  CLI::App* pvs_command =
      command->add_subcommand("pvs", "What can be seen from where in a region, for --pvs; on all cores");
  pvs_command
      ->add_option("REGION", pvs->planet, "as for shot and fly, with the same --center, --side, --spacing")
      ->required();
  add_local_region_options(*pvs_command, pvs->region);
  pvs_command->add_option("--exaggeration", pvs->exaggeration, "as for shot and fly")
      ->capture_default_str()
      ->check(in_range(0.0, 100.0));
  pvs_command->add_option("--memory", pvs->memory_mb, "MB of decoded maps and of ground made of them to keep")
      ->capture_default_str()
      ->check(CLI::Range(64, 1 << 20));
  pvs_command->add_option("-o,--output", pvs->output, "file to write")->required();
  pvs_command->add_flag("--overwrite", pvs->overwrite, "replace existing output");
  pvs_command->add_flag("--quiet", pvs->quiet, "warnings and errors only");
  pvs_command->callback([pvs] { write_pvs(*pvs); });
}

}  // namespace app
