#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/bench.h"
#include "app/commands.h"
#include "app/flat_region.h"
#include "app/parse_options.h"
#include "app/progress.h"
#include "app/scene_argument.h"
#include "app/scene_plan.h"
#include "app/standing_camera.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/gl/context.h"
#include "globe/render/globe_renderer.h"

namespace app {
namespace {

namespace geo = globe::geo;
namespace render = globe::render;

constexpr double kLowest = 2.0;       ///< metres above ground, of the heights that are tried
constexpr double kHighest = 4e7;      ///< both on a planet like the Earth
constexpr double kRung = 2.2;         ///< from one height to the next
constexpr double kExactEnough = 1.1;  ///< between the two heights that a change is found between
constexpr int kSmallWidth = 96, kSmallHeight = 54;

struct ExplainOptions {
  ViewOptions view;
  StandOptions stand;
  int rounds = 21;
  bool json = false;
};

/// The scene's frames at one place, with some of its effects.
class Frame {
 public:
  Frame(const ExplainOptions& options, const Optics& optics, const Size& size,
        const globe::scene::Scene& scene, const std::shared_ptr<const globe::planet::Surface>& surface,
        const std::optional<FlatRegion>& region)
      : renderer(surface, render_settings(options.view), effects_of(scene, *surface, optics),
                 region_in_globe(region, scene, render_settings(options.view))),
        lens(optics, size.width, size.height, options.view.samples,
             render_settings(options.view).background) {}

  void draw(const render::Camera& camera, const Sunlight& sun, double seconds) {
    renderer.set_instant(sun.instant(seconds));
    lens.draw(renderer, camera, sun.at(seconds), true);
    lens.target().resolve();
    glFinish();
  }

  render::GlobeRenderer renderer;
  Lens lens;
};

globe::scene::Scene without(globe::scene::Scene scene, std::size_t effect) {
  scene.effects.erase(scene.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  return scene;
}

/// Over which heights each effect is active.
class HeightSearch {
 public:
  using ActiveAt = std::function<std::vector<bool>(double above_m)>;

  HeightSearch(double scale, ActiveAt active_at) : active_at_(std::move(active_at)) {
    for (double h = kLowest * scale; h < kHighest * scale; h *= kRung) rungs_.push_back({h, active_at_(h)});
  }

  std::vector<Stretch> stretches(std::size_t effect) {
    std::vector<Stretch> found;
    double since = 0.0;
    for (std::size_t k = 1; k < rungs_.size(); ++k) {
      const bool before = rungs_[k - 1].active[effect], now = rungs_[k].active[effect];
      if (before == now) continue;
      const double change = change_between(rungs_[k - 1].above_m, rungs_[k].above_m, effect, now);
      if (now) {
        since = change;
      } else {
        found.push_back({since, change});
      }
    }
    if (rungs_.back().active[effect]) found.push_back({since, std::numeric_limits<double>::infinity()});
    return found;
  }

 private:
  struct Rung {
    double above_m;
    std::vector<bool> active;
  };

  double change_between(double low, double high, std::size_t effect, bool active_above) const {
    while (high > low * kExactEnough) {
      const double middle = std::sqrt(low * high);
      (active_at_(middle)[effect] == active_above ? high : low) = middle;
    }
    return std::sqrt(low * high);
  }

  ActiveAt active_at_;
  std::vector<Rung> rungs_;
};

Time time_of(const std::vector<double>& nanoseconds) {
  std::vector<double> ms = nanoseconds;
  for (double& value : ms) value *= 1e-6;
  std::sort(ms.begin(), ms.end());
  const Interval interval = median_interval(ms);
  return {ms[ms.size() / 2], interval.low, interval.high};
}

/// Frames of the whole scene beside those of another, drawn in turn.
std::vector<Time> times_of(std::vector<std::function<void()>> frames, int rounds) {
  std::vector<Benchmark> benchmarks;
  for (std::function<void()>& frame : frames) {
    frame();  // loads and compiles what it needs
    frame();
    benchmarks.push_back({"", 1, std::move(frame)});
  }
  std::vector<Time> times;
  for (const BenchmarkResult& result : run_interleaved(benchmarks, rounds))
    times.push_back(time_of(result.ns));
  return times;
}

Plan plan_of(ExplainOptions options, const CLI::App& command) {
  ViewOptions& view = options.view;
  const std::string file = view.planet;
  const std::optional<globe::scene::Scene> scene = take_scene(command, view);
  if (!scene) throw globe::UsageError(file, "not a scene", "give a file that ends in .toml (README, Scenes)");
  const Optics optics = optics_of(view.optics);
  const Size size = size_of(view, optics);
  const geo::Geodetic sunny = target_of(options.stand, scene);
  const auto surface = open_planet(view);
  const geo::Ellipsoid& ellipsoid = surface->ellipsoid();
  const std::optional<FlatRegion> region = region_of(scene, surface, view.quiet || options.json);
  const Sunlight sun = sun_for(view, *surface, sunny);
  const double seconds = options.stand.moment_s;
  const globe::gl::Context context(view.device);

  Plan plan;
  Frame whole(options, optics, size, *scene, surface, region);
  const auto above = [&](const glm::dvec3& at) { return whole.renderer.height_above_ground(at); };
  const Standpoint stand =
      standpoint(options.stand, view, scene, surface, render_settings(view).max_level, above);
  const double aspect = static_cast<double>(size.width) / size.height;
  const render::Camera camera = optics.camera(ellipsoid, stand.place, stand.look, aspect);
  whole.draw(camera, sun, seconds);
  plan.scene = file;
  plan.renderer = context.renderer();
  plan.place = stand.place;
  plan.above_ground_m = above(camera.position);
  plan.size = size;
  plan.light_bytes = whole.renderer.light_bytes();
  for (const render::EffectState& state : whole.renderer.effect_states()) {
    const auto asked = std::find_if(scene->effects.begin(), scene->effects.end(),
                                    [&](const auto& effect) { return effect.name == state.name; });
    plan.effects.push_back({state, asked->line, {}, {}});
  }
  const auto measured_beside_whole = [&](const globe::scene::Scene& other) {
    Frame frame(options, optics, size, other, surface, region);
    return times_of({[&] { whole.draw(camera, sun, seconds); }, [&] { frame.draw(camera, sun, seconds); }},
                    options.rounds);
  };
  if (const render::RegionRenderer* drawn = whole.renderer.region()) {
    plan.region = {drawn->patches(), drawn->triangles(), drawn->gpu_bytes(), {}, {}};
    globe::scene::Scene other = *scene;
    other.region.reset();
    const std::vector<Time> times = measured_beside_whole(other);
    plan.region->with = times[0];
    plan.region->without = times[1];
  }
  if (plan.effects.empty()) {
    plan.all = plan.none = times_of({[&] { whole.draw(camera, sun, seconds); }}, options.rounds).front();
    return plan;
  }

  Progress progress(progress_style(view.quiet, false));
  {
    Frame small(options, {}, {kSmallWidth, kSmallHeight}, *scene, surface, region);
    HeightSearch heights(geo::small_body_scale(ellipsoid), [&](double above_m) {
      progress.show("trying heights", std::log(above_m / kLowest) / std::log(kHighest / kLowest));
      geo::Geodetic place = stand.place;
      place.h_m += above_m - small.renderer.height_above_ground(geo::ecef_from_geodetic(ellipsoid, place));
      const double radius = ellipsoid.mean_radius();
      const double dip = std::acos(radius / (radius + std::max(place.h_m, 0.0))) * 180.0 / glm::pi<double>();
      small.draw(Optics{}.camera(ellipsoid, place, {stand.look.heading_deg, -dip}, aspect), sun, seconds);
      std::vector<bool> active;
      for (const render::EffectState& state : small.renderer.effect_states())
        active.push_back(state.verdict.active);
      return active;
    });
    for (std::size_t k = 0; k < plan.effects.size(); ++k) plan.effects[k].active = heights.stretches(k);
  }

  globe::scene::Scene bare = *scene;
  bare.effects.clear();
  const std::vector<Time> ends = measured_beside_whole(bare);
  plan.all = ends[0];
  plan.none = ends[1];
  for (std::size_t k = 0; k < plan.effects.size(); ++k) {
    progress.show("measuring " + plan.effects[k].state.name,
                  static_cast<double>(k + 1) / static_cast<double>(plan.effects.size() + 1));
    const auto asked = std::find_if(scene->effects.begin(), scene->effects.end(), [&](const auto& effect) {
      return effect.name == plan.effects[k].state.name;
    });
    const auto at = static_cast<std::size_t>(asked - scene->effects.begin());
    if (plan.effects.size() == 1) {
      plan.effects[k].without = plan.none;
    } else {
      const std::vector<Time> pair = measured_beside_whole(without(*scene, at));
      // The whole scene's frame was measured again beside it: the machine's pace meanwhile falls on both.
      const double pace = plan.all.median / pair[0].median;
      plan.effects[k].without = Time{pair[1].median * pace, pair[1].low * pace, pair[1].high * pace};
    }
  }
  progress.clear();
  return plan;
}

}  // namespace

void add_explain(CLI::App& program) {
  auto options = std::make_shared<ExplainOptions>();
  CLI::App* command = program.add_subcommand(
      "explain", "The plan of a scene: its effects, when they work and what they cost");
  add_drawing_options(*command, options->view);
  add_stand_options(*command, options->stand);
  command->add_option("--rounds", options->rounds, "frames measured of each kind, interleaved")
      ->capture_default_str()
      ->check(in_range(5, 10000));
  command->add_flag("--json", options->json, "one JSON object");
  command->footer(
      "ms on and off: a frame of the scene as it is, and one of the scene without that effect, medians of "
      "interleaved\nframes; in parentheses 95 % intervals.  The heights at which an effect is active are "
      "tried out "
      "over the camera's\nplace, the horizon in the middle of the picture.\n"
      "Example: globe explain scenes/fog.toml --at 46,7,4000");
  command->callback([options, command] {
    const Plan plan = plan_of(*options, *command);
    std::fputs((options->json ? json_of(plan) : text_of(plan)).c_str(), stdout);
  });
}

}  // namespace app
