#include "app/flat_options.h"

#include <cstdio>
#include <memory>

#include "app/optics.h"
#include "app/parse_options.h"
#include "app/scene_argument.h"

namespace app {
namespace {

namespace flat = globe::flat;
namespace geo = globe::geo;

/// Takes a scene's region into the options that were not given.
void take_region(const CLI::App& command, const globe::scene::Region& region, FlatOptions& options) {
  const auto is_given = [&](const char* option) { return command.get_option(option)->count() > 0; };
  char text[96];
  if (!is_given("--center")) {
    std::snprintf(text, sizeof text, "%.12f,%.12f", region.center.lat_deg, region.center.lon_deg);
    options.region.center = text;
  }
  if (!is_given("--side")) {
    std::snprintf(text, sizeof text, "%.17gm", region.side_m);
    options.region.side = text;
  }
  if (!is_given("--spacing") && region.spacing_m) {
    std::snprintf(text, sizeof text, "%.17gm", *region.spacing_m);
    options.region.spacing = text;
  }
  if (!is_given("--error")) options.error_px = region.error_px;
  if (!is_given("--shadows")) options.shadows = region.shadows ? "on" : "off";
  if (!is_given("--materials")) options.materials = region.materials ? "on" : "off";
}

}  // namespace

void add_flat_options(CLI::App& command, FlatOptions& options) {
  command
      .add_option(
          "REGION", options.planet,
          "a height map of a place, a folder made by globe convert or procedural[:SEED] (with --center), "
          "fractal[:SEED], or a scene, SCENE.toml")
      ->required();
  add_local_region_options(command, options.region);
  add_eye_options(command, options);
  add_picture_options(command, options);
  command
      .add_option("--error", options.error_px,
                  "pixels that the mesh may be off at most: patches take the coarsest level under it")
      ->capture_default_str()
      ->check(in_range(0.0, 1000.0));
  const auto on_off = [&](const char* name, std::string& value, const char* help) {
    command.add_option(name, value, help)->capture_default_str()->check(CLI::IsMember({"on", "off"}));
  };
  command
      .add_option(
          "--morph", options.morph_by,
          "how levels change: gradually by the vertex shader (gpu) or by this program (cpu), or at once")
      ->capture_default_str()
      ->check(CLI::IsMember({"off", "cpu", "gpu"}));
  on_off("--lod", options.lod, "off: every post is drawn");
  on_off("--culling", options.culling, "off: patches out of view are drawn too");
  on_off("--shadows", options.shadows, "off: the ground throws no shadows");
  on_off("--materials", options.materials, "on: grass, stone and mud, a pass each where they are");
  command
      .add_option("--cloud-shadows", options.cloud_shadows,
                  "share of the sky whose clouds throw shadows, which move")
      ->capture_default_str()
      ->check(in_range(0.0, 1.0));
  command.add_option("--pvs", options.pvs, "file made by globe flat pvs: patches it hides are not drawn");
}

flat::GeomipmapSettings geomipmap_settings(const FlatOptions& options, const FlatRegion& region) {
  flat::GeomipmapSettings settings;
  settings.error_px = options.error_px;
  settings.morph = options.morph_by == "off"   ? flat::Morph::kOff
                   : options.morph_by == "cpu" ? flat::Morph::kCpu
                                               : flat::Morph::kGpu;
  settings.lod = options.lod == "on";
  settings.culling = options.culling == "on";
  settings.shadows = options.shadows == "on";
  settings.show = show_of(options);
  settings.wireframe = options.wireframe;
  settings.background = background_of(options);
  settings.air = region.air;
  if (options.materials == "on") settings.materials = flat::grass_stone_and_mud(*region.terrain);
  settings.cloud_cover = options.cloud_shadows;
  if (!options.pvs.empty())
    settings.visibility =
        std::make_shared<const flat::Visibility>(flat::Visibility::read(options.pvs, *region.terrain));
  return settings;
}

void check_options(const FlatOptions& options) {
  size_of(options, optics_of(options.optics));
  if (!options.look.empty()) parse_look(options.look);
  background_of(options);
}

std::optional<globe::scene::Scene> take_flat_scene(const CLI::App& command, FlatOptions& options) {
  std::optional<globe::scene::Scene> scene = take_scene(command, options);
  if (scene && !scene->effects.empty())
    std::fprintf(stderr,
                 "globe: warning: %s:%d: effects.%s: not drawn over a region alone; globe shot and globe fly "
                 "draw them over one in the globe\n",
                 scene->file.c_str(), scene->effects.front().line, scene->effects.front().name.c_str());
  if (scene && scene->region) take_region(command, *scene->region, options);
  return scene;
}

Start start_of(const FlatOptions& options, const std::optional<globe::scene::Scene>& scene) {
  Start start{std::nullopt, options.agl, std::nullopt};
  if (scene && scene->camera) {
    start = {scene->camera->at, options.agl || scene->camera->agl, std::nullopt};
    start.look = look_of(*scene->camera);
  }
  if (!options.at.empty()) start.at = parse_point(options.at);
  return start;
}

std::optional<geo::Geodetic> place_of(const Start& start) {
  if (!start.at) return std::nullopt;
  return start.at->position;
}

}  // namespace app
