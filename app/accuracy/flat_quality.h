#pragma once

#include <memory>
#include <vector>

#include "app/accuracy/drawing_quality.h"
#include "flat/geomipmap_renderer.h"
#include "flat/terrain.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"

namespace app::accuracy {

/// The region that flat drawing is judged by: fractal ground, which needs no data; 8 km a side, 512 cells.
std::shared_ptr<const globe::flat::Terrain> judged_region();

/// All of a region from beside it; from 1000, 200 and 30 m above its ground, and at eye height.
std::vector<JudgedView> judged_region_views(const globe::flat::Terrain& terrain, const PictureSize& picture);

/// How far the ground that a region is drawn with is from the ground at every post, straight above or below
/// what a pixel shows (seen_ground.h), pixels. With levels that turn into each other.
ErrorFigure displacement(const globe::flat::Terrain& terrain, double error_px,
                         const std::vector<JudgedView>& views, const PictureSize& picture);

/// A region drawn off screen again and again.
class RegionFrame {
 public:
  RegionFrame(std::shared_ptr<globe::gl::Context> context,
              const std::shared_ptr<const globe::flat::Terrain>& terrain,
              const globe::flat::GeomipmapSettings& settings, const PictureSize& picture);

  /// Milliseconds of one frame, until the driver has drawn it. The first one also lights the ground.
  double draw_ms(const globe::render::Camera& camera);

  const globe::flat::GeomipmapRenderer& renderer() const { return renderer_; }
  const globe::gl::Framebuffer& target() const { return target_; }

 private:
  std::shared_ptr<globe::gl::Context> context_;  ///< outlives what is made in it
  globe::flat::GeomipmapRenderer renderer_;
  globe::gl::Framebuffer target_;
  glm::dvec3 sun_;
};

/// A camera in the axes of a frame, and the other way about.
globe::render::Camera camera_in_frame(const globe::flat::TangentFrame& frame,
                                      const globe::render::Camera& camera);

/// z over every post of the meshes that patches of such levels have, row by row from the south-west.
std::vector<float> mesh_heights(const globe::flat::Terrain& terrain, const std::vector<float>& levels);

constexpr int kWalked = 40;
constexpr double kStep_m = 1.0;
/// Steps of kStep_m of a low walk over a region from south to north, far apart.
struct WalkStep {
  globe::render::Camera before, after;
};
std::vector<WalkStep> walk_over(const globe::flat::Terrain& terrain, const PictureSize& picture,
                                int steps = kWalked);

/// How far posts in view leap on the screen in the steps of a walk, beyond what the camera's own going moves
/// them by: pixels.
ErrorFigure leaps(const globe::flat::Terrain& terrain, globe::flat::Morph morph, double error_px,
                  const PictureSize& picture, const std::vector<WalkStep>& walk);

/// Part of a planet as a region: what lies between its posts.
class PlanetGround {
 public:
  static constexpr int kUsualPosts = 1024;          ///< of a side (app/flat_region.cpp)
  static constexpr double kUsualSide_m = 40'000.0;  ///< likewise
  static constexpr double kSide_m = 5'000.0;        ///< judged
  static constexpr int kFinest = 21;                ///< level that counts as true

  /// Around the planet's mountains.
  explicit PlanetGround(std::shared_ptr<const globe::planet::Surface> surface);

  /// Places on the true ground, in the frame: the same on every run.
  const std::vector<glm::dvec3>& places() const { return places_; }
  /// Of posts so far apart, kSide_m / (16 n).
  std::shared_ptr<const globe::flat::Terrain> terrain(double spacing_m) const;
  /// How far terrain(spacing_m) is below or above the places, metres.
  ErrorFigure error(double spacing_m) const;

 private:
  std::shared_ptr<const globe::planet::Surface> surface_;
  globe::flat::TangentFrame frame_;
  std::vector<glm::dvec3> places_;
};

}  // namespace app::accuracy
