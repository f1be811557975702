#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/render/globe_renderer.h"

namespace app::accuracy {

/// A view drawn off screen again and again: what drawing costs that has all it needs.
class RepeatedFrame {
 public:
  RepeatedFrame(std::shared_ptr<globe::gl::Context> context,
                const std::shared_ptr<const globe::planet::Surface>& surface,
                const globe::render::RenderSettings& settings, int width, int height,
                const globe::gl::FramebufferFormat& format = {});

  /// Milliseconds of one frame, until the driver has drawn it. A camera other than the last one's is first
  /// drawn without being measured.
  double draw_ms(const globe::render::Camera& camera, const glm::dvec3& sun);

  const globe::render::FrameStats& stats() const { return stats_; }
  const globe::gl::Framebuffer& target() const { return target_; }

 private:
  std::shared_ptr<globe::gl::Context> context_;  ///< outlives what is made in it
  globe::render::GlobeRenderer renderer_;
  globe::gl::Framebuffer target_;
  std::optional<globe::render::Camera> last_;
  globe::render::FrameStats stats_;
};

/// The sun that views are drawn in: ten in the morning under the camera.
glm::dvec3 sun_over(const globe::planet::Surface& surface, const globe::render::Camera& camera);

}  // namespace app::accuracy
