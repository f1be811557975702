#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "app/accuracy/endless_quality.h"
#include "app/accuracy/flat_quality.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/study.h"

namespace app::accuracy {
namespace {

namespace flat = globe::flat;

constexpr double kDefaultError = 1.0;  ///< app/flat.cpp
const std::string kRegion = "8 km of fractal hills, 513x513 posts";

using Region = std::shared_ptr<const flat::Terrain>;

/// Frame times and triangles of settings that err by what is given.
struct CostStudies {
  Study frames, triangles;

  void add(const std::string& name, const ErrorFigure& error, std::function<double()> ms,
           std::function<void()> release, std::size_t drawn, bool is_default) {
    frames.settings.push_back({name, error, std::move(ms), is_default, {}, std::move(release)});
    triangles.settings.push_back({name, error, fixed(static_cast<double>(drawn) * 1e-3), is_default});
  }
};

CostStudies cost_studies(const std::string& name, const std::string& title, const std::string& knob,
                         const std::string& sample, const std::string& view) {
  Study frames{"flat." + name,
               title + ", against time",
               knob,
               "the ground at every post, straight above or below what a pixel shows",
               sample,
               "px",
               "ms a frame of 1280x720 pixels, " + view,
               {}};
  Study triangles = frames;
  triangles.name += ".triangles";
  triangles.title = title + ", against the number of triangles";
  triangles.cost_unit = "thousand triangles, " + view;
  return {std::move(frames), std::move(triangles)};
}

std::string pixels(double error_px) {
  char text[32];
  std::snprintf(text, sizeof text, "%g px", error_px);
  return text;
}

/// The bound that levels are chosen by, and what the ground drawn is off by.
void add_levels(const Scope& scope, const Region& region, std::vector<Study>& studies) {
  const std::vector<JudgedView> views = judged_region_views(*region, kPicture);
  CostStudies costs = cost_studies(
      "levels", "Bound that levels of a region stay under", "flat --error, flat --lod",
      "every second pixel, across and down, of 1280x720 from beside all of it, from 1000, 200 and 30 m and "
      "eye height over " +
          kRegion,
      "from 200 m");
  const auto add = [&](const std::string& name, const ErrorFigure& error,
                       const flat::GeomipmapSettings& settings, bool is_default) {
    const auto frame = remade<RegionFrame>(scope.context, region, settings, kPicture);
    const globe::render::Camera camera = views[2].camera;
    frame->get().draw_ms(camera);
    const std::size_t triangles = frame->get().renderer().frame_stats().triangles;
    frame->release();
    costs.add(
        name, error, [=] { return frame->get().draw_ms(camera); }, release_of(frame), triangles, is_default);
  };
  flat::GeomipmapSettings settings;
  settings.lod = false;
  add("--lod off", {}, settings, false);  // the reference
  settings.lod = true;
  for (const double error_px : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    settings.error_px = error_px;
    add(pixels(error_px), displacement(*region, error_px, views, kPicture), settings,
        error_px == kDefaultError);
  }
  studies.push_back(std::move(costs.frames));
  studies.push_back(std::move(costs.triangles));
}

/// The walk that leaps are looked for in, frame by frame.
class Walk {
 public:
  Walk(std::shared_ptr<globe::gl::Context> context, const Region& region, flat::Morph morph)
      : frame_(std::move(context), region, settings_of(morph), kPicture),
        steps_(walk_over(*region, kPicture)) {
    frame_.draw_ms(steps_.front().before);
  }
  double draw_next_ms() {
    const WalkStep& step = steps_[next_ / 2 % steps_.size()];
    const double ms = frame_.draw_ms(next_ % 2 == 0 ? step.before : step.after);
    ++next_;
    return ms;
  }

 private:
  static flat::GeomipmapSettings settings_of(flat::Morph morph) {
    flat::GeomipmapSettings settings;
    settings.morph = morph;
    return settings;
  }
  RegionFrame frame_;
  std::vector<WalkStep> steps_;
  std::size_t next_ = 0;
};

Study morphs(const Scope& scope, const Region& region) {
  Study study{"flat.morph",
              "Levels of a region that turn into each other, and levels that change at once",
              "flat --morph",
              "the picture just before: where a post's ground stood",
              "all posts in view in " + std::to_string(kWalked) + " steps of 1 m of a walk 30 m over " +
                  kRegion + ", bound 1 px",
              "px",
              "ms a frame of 1280x720 pixels, in the walk",
              {}};
  const std::vector<WalkStep> steps = walk_over(*region, kPicture);
  struct Way {
    const char* name;
    flat::Morph morph;
  };
  for (const Way& way :
       {Way{"off", flat::Morph::kOff}, Way{"cpu", flat::Morph::kCpu}, Way{"gpu", flat::Morph::kGpu}}) {
    const auto walk = remade<Walk>(scope.context, region, way.morph);
    study.settings.push_back({way.name,
                              leaps(*region, way.morph, kDefaultError, kPicture, steps),
                              [=] { return walk->get().draw_next_ms(); },
                              way.morph == flat::Morph::kGpu,
                              {},
                              release_of(walk)});
  }
  return study;
}

/// Heights between posts.
Study spacings(const Scope& scope) {
  const PlanetGround ground(scope.planet);
  Study study{"flat.spacing",
              "Posts of a region cut out of a planet",
              "flat --spacing",
              "the planet's ground at level " + std::to_string(PlanetGround::kFinest) + ", 5 m",
              std::to_string(ground.places().size()) + " places of 5 km of the built-in planet's mountains",
              "m",
              "MB of posts a square of 40 km",
              {}};
  for (const int share : {512, 1024, 2048, 4096}) {
    const double spacing_m = PlanetGround::kUsualSide_m / share;
    const double posts = share + 1;
    char name[32];
    std::snprintf(name, sizeof name, "%.1f m", spacing_m);
    study.settings.push_back({name, ground.error(spacing_m),
                              fixed(2.0 * sizeof(float) * posts * posts * 1e-6),
                              share == PlanetGround::kUsualPosts});
  }
  return study;
}

/// Radii of the levels of endless ground.
void add_rings(const Scope& scope, std::vector<Study>& studies) {
  const std::vector<EndlessView> views = judged_endless_views(kPicture);
  CostStudies costs =
      cost_studies("endless", "Radii of the levels of endless ground", "flat --lod, flat endless --rings",
                   "every second pixel, across and down, of 1280x720 from " + std::to_string(views.size()) +
                       " places of a flight 300 m over endless fractal ground",
                   "where the flight begins");
  const auto add = [&](const std::string& name, const std::optional<flat::fractal::Rings>& rings,
                       bool is_default) {
    const auto ground = endless_ground(rings);
    const ErrorFigure error = rings ? displacement(ground, views, kPicture) : ErrorFigure{};
    const auto frame = remade<EndlessFrame>(scope.context, ground, kPicture);
    const EndlessView& view = views.front();
    frame->get().draw_ms(view);
    const std::size_t triangles = frame->get().triangles();
    frame->release();
    costs.add(
        name, error, [=] { return frame->get().draw_ms(view); }, release_of(frame), triangles, is_default);
  };
  add("--lod off", std::nullopt, false);
  for (const double blocks : {5.12, 10.24, 20.48}) {
    char name[48];
    std::snprintf(name, sizeof name, "%.0f and %.0f m", 250.0 * blocks, 500.0 * blocks);
    add(name, flat::fractal::Rings{blocks, 2.0 * blocks}, blocks == 10.24);
  }
  studies.push_back(std::move(costs.frames));
  studies.push_back(std::move(costs.triangles));
}

}  // namespace

std::vector<Study> flat_studies(const Scope& scope) {
  const Region region = judged_region();
  std::vector<Study> studies;
  add_levels(scope, region, studies);
  studies.push_back(morphs(scope, region));
  studies.push_back(spacings(scope));
  add_rings(scope, studies);
  return studies;
}

}  // namespace app::accuracy
