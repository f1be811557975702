#include "app/view/canvas.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace app::view {

namespace render = globe::render;

Canvas::Canvas(glm::ivec2 size, int samples) : picture_(size.x, size.y, {samples}) {}

render::FrameStats Canvas::draw(Scenery& scenery, const render::Camera& camera, const Sunlight& sun,
                                double moment_s, bool wait, double upload_ms) {
  render::SurfaceRenderer& renderer = scenery.renderer();
  renderer.set_instant(sun.instant(moment_s));
  const render::FrameStats drawn = renderer.draw(camera, sun.at(moment_s), wait, picture_, upload_ms);
  picture_.resolve();
  camera_ = camera;
  near_m_ = render::near_distance(scenery.ellipsoid(), renderer.nearest_drawn(camera.position, wait));
  return drawn;
}

std::optional<glm::dvec3> Canvas::seen_at(glm::dvec2 pixel) const {
  const int column = static_cast<int>(std::floor(pixel.x)), row = static_cast<int>(std::floor(pixel.y));
  if (!camera_ || column < 0 || row < 0 || column >= picture_.width() || row >= picture_.height())
    return std::nullopt;
  const double depth = static_cast<double>(picture_.read_depth_at(column, row));
  if (!(depth > 0.0)) return std::nullopt;
  const glm::dvec3 direction =
      render::direction_through(*camera_, pixel.x / picture_.width(), pixel.y / picture_.height());
  return camera_->position + direction * (near_m_ / depth / glm::dot(direction, camera_->forward));
}

}  // namespace app::view
