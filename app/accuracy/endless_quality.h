#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/accuracy/drawing_quality.h"
#include "flat/fractal/drawer.h"
#include "flat/fractal/terrain.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"

namespace app::accuracy {

/// A view over endless fractal ground.
struct EndlessView {
  std::string name;
  globe::render::Camera camera;  ///< its position is not read
  glm::dvec3 eye;                ///< posts east and north, metres up
};

/// What `globe flat endless` draws unless it is told otherwise, with other radii of the levels (sides of a
/// block), or with every post where there are none.
globe::flat::fractal::TerrainSettings endless_ground(const std::optional<globe::flat::fractal::Rings>& rings);

/// Views along a flight of `globe flat endless`, 300 m over the ground.
std::vector<EndlessView> judged_endless_views(const PictureSize& picture);

/// How far endless ground is drawn from that at every post, straight above or below what a pixel shows
/// (seen_ground.h), pixels.
ErrorFigure displacement(const globe::flat::fractal::TerrainSettings& settings,
                         const std::vector<EndlessView>& views, const PictureSize& picture);

constexpr double kEndlessNear_m = 1.0;  ///< the near plane it is drawn with

/// Endless ground drawn off screen again and again.
class EndlessFrame {
 public:
  EndlessFrame(std::shared_ptr<globe::gl::Context> context,
               const globe::flat::fractal::TerrainSettings& settings, const PictureSize& picture);

  /// Milliseconds of one frame, until the driver has drawn it.
  double draw_ms(const EndlessView& view);

  std::size_t triangles() const { return triangles_; }  ///< of the last frame
  const globe::gl::Framebuffer& target() const { return target_; }

 private:
  std::shared_ptr<globe::gl::Context> context_;  ///< outlives what is made in it
  globe::flat::fractal::Terrain terrain_;
  globe::flat::fractal::Drawer drawer_;
  globe::gl::Framebuffer target_;
  std::size_t triangles_ = 0;
};

}  // namespace app::accuracy
