#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/view_options.h"
#include "globe/geo/ellipsoid.h"
#include "globe/render/globe_renderer.h"

namespace app {

/// Heights above ground, metres.
struct Stretch {
  double from_m = 0;
  double to_m = 0;
};

/// Median and 95 % interval, milliseconds.
struct Time {
  double median = 0, low = 0, high = 0;
};

/// What becomes of one effect of a scene.
struct PlannedEffect {
  globe::render::EffectState state;
  int line = 0;                 ///< of the scene that asks for it
  std::vector<Stretch> active;  ///< over the camera's place, the horizon in the middle of the picture
  std::optional<Time> without;  ///< a frame with all other effects
};

/// What becomes of a scene's region.
struct PlannedRegion {
  std::size_t patches = 0;  ///< in view
  std::size_t triangles = 0;
  std::size_t gpu_bytes = 0;
  Time with, without;  ///< frames of the scene
};

/// What `globe explain` found out about a scene.
struct Plan {
  std::string scene;     ///< its file
  std::string renderer;  ///< GL_RENDERER
  globe::geo::Geodetic place;
  double above_ground_m = 0;
  Size size;
  std::vector<PlannedEffect> effects;
  std::optional<PlannedRegion> region;
  std::size_t light_bytes = 0;
  Time all, none;  ///< frames of the scene as it is, and without effects
};

/// A table for people.
std::string text_of(const Plan& plan);
/// One JSON object (keys in COMMANDS.md).
std::string json_of(const Plan& plan);

}  // namespace app
