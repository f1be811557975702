#include "app/accuracy/repeated_frame.h"

#include <epoxy/gl.h>

#include <chrono>
#include <utility>

#include "globe/geo/sun.h"

namespace app::accuracy {

RepeatedFrame::RepeatedFrame(std::shared_ptr<globe::gl::Context> context,
                             const std::shared_ptr<const globe::planet::Surface>& surface,
                             const globe::render::RenderSettings& settings, int width, int height,
                             const globe::gl::FramebufferFormat& format)
    : context_(std::move(context)), renderer_(surface, settings), target_(width, height, format) {}

double RepeatedFrame::draw_ms(const globe::render::Camera& camera, const glm::dvec3& sun) {
  if (!last_ || last_->position != camera.position || last_->forward != camera.forward) {
    renderer_.draw(camera, sun, true, target_);
    last_ = camera;
  }
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  stats_ = renderer_.draw(camera, sun, true, target_);
  target_.resolve();
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

glm::dvec3 sun_over(const globe::planet::Surface& surface, const globe::render::Camera& camera) {
  return globe::geo::morning_sun(
      globe::geo::geodetic_from_ecef(surface.ellipsoid(), camera.position).lon_deg);
}

}  // namespace app::accuracy
