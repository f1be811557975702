#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "app/flat_region.h"
#include "app/point.h"
#include "app/standing_camera.h"
#include "app/view_options.h"
#include "flat/geomipmap_renderer.h"
#include "globe/scene/scene.h"

namespace app {

/// What `globe flat shot`, `fly` and `view` are told of a region and how it is drawn.
struct FlatOptions : ViewOptions {
  LocalRegionOptions region;
  std::string at;
  double error_px = 1.0;
  std::string morph_by = "gpu";
  std::string lod = "on";
  std::string culling = "on";
  std::string shadows = "on";
  std::string materials = "off";
  double cloud_shadows = 0;
  std::string pvs;
  double moment_s = 0;  ///< of moving shadows
};

/// The region, its camera, what becomes of pixels and how it is drawn; not the output.
void add_flat_options(CLI::App& command, FlatOptions& options);

/// Throws globe::Error for sets of visible patches that are not this region's.
globe::flat::GeomipmapSettings geomipmap_settings(const FlatOptions& options, const FlatRegion& region);

/// Throws UsageError for what can be seen to be wrong before anything is opened.
void check_options(const FlatOptions& options);

/// The scene, where the word for the region names one, its planet, picture and region taken into the options
/// that were not given; effects are left out with a warning.
std::optional<globe::scene::Scene> take_flat_scene(const CLI::App& command, FlatOptions& options);

/// Where the camera stands at first: --at, or the scene's camera.
struct Start {
  std::optional<Point> at;
  bool agl = false;
  std::optional<Look> look;
};
Start start_of(const FlatOptions& options, const std::optional<globe::scene::Scene>& scene);
std::optional<globe::geo::Geodetic> place_of(const Start& start);

}  // namespace app
