#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/view/scenery.h"
#include "globe/gl/framebuffer.h"
#include "globe/render/camera.h"

namespace app::view {

/// The picture in a window: what was drawn last, and what is where in it.
class Canvas {
 public:
  /// A GL context must be current and stay so.
  Canvas(glm::ivec2 size, int samples);

  /// @param wait  true: complete; false: what is at hand, uploads taking `upload_ms`
  globe::render::FrameStats draw(Scenery& scenery, const globe::render::Camera& camera, const Sunlight& sun,
                                 double moment_s, bool wait, double upload_ms);

  glm::ivec2 size() const { return {picture_.width(), picture_.height()}; }
  const globe::gl::Framebuffer& picture() const { return picture_; }
  double near_m() const { return near_m_; }

  /// The place that is seen at a pixel, ECEF; nothing where there is sky, or nothing was drawn.
  std::optional<glm::dvec3> seen_at(glm::dvec2 pixel) const;

 private:
  globe::gl::Framebuffer picture_;
  std::optional<globe::render::Camera> camera_;  ///< that it was drawn for
  double near_m_ = 1;
};

}  // namespace app::view
