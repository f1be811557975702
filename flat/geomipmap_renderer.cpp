#include "flat/geomipmap_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "globe/render/ground_state.h"
#include "globe/render/view_block.h"

namespace globe::flat {
namespace {

constexpr double kLeastAbove = 0.1;  ///< metres: no camera counts as nearer to the ground

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

GeomipmapRenderer::GeomipmapRenderer(std::shared_ptr<const Terrain> terrain, std::vector<glm::vec4> colors,
                                     const GeomipmapSettings& settings)
    : ground_(std::move(terrain), std::move(colors), settings, no_effects_),
      background_(settings.background),
      cull_faces_(settings.cull_faces),
      air_(settings.air),
      view_(sizeof(render::ViewBlock)) {
  if (!background_) sky_.emplace(air_, settings.air_steps, no_effects_);
}

double GeomipmapRenderer::height_above_ground(const glm::dvec3& position, bool /*wait*/) const {
  return terrain().height_above(position);
}

double GeomipmapRenderer::nearest_drawn(const glm::dvec3& position, bool wait) const {
  return std::max(height_above_ground(position, wait), kLeastAbove);
}

void GeomipmapRenderer::warm_up(const gl::Framebuffer& target) {
  const PostRect& posts = terrain().posts();
  const TangentFrame& frame = terrain().frame();
  const double x = terrain().x_m(posts.columns / 2);
  const double y = terrain().y_m(posts.rows / 2);
  render::Camera camera;
  camera.position =
      frame.ecef_from_local({x, y, terrain().z_at(x, y) + posts.columns * terrain().spacing_m()});
  camera.forward = -frame.axes()[2];
  camera.right = frame.axes()[0];
  camera.up = frame.axes()[1];
  draw(camera, frame.axes()[2], true, target);
}

void GeomipmapRenderer::begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait,
                                    double /*upload_ms*/) {
  stats_ = {};
  sun_ = sun;
  above_m_ = nearest_drawn(position, wait);
  ground_.begin_frame(sun, wait);
}

void GeomipmapRenderer::draw_view(const render::Camera& camera, const gl::Framebuffer& target) {
  const auto begin = std::chrono::steady_clock::now();
  const GroundView seen{camera, instant_, target.height()};
  ground_.prepare(seen);
  stats_.patches += ground_.visible().size();
  stats_.cpu_ms += milliseconds_since(begin);

  const geo::Ellipsoid& ellipsoid = terrain().frame().ellipsoid();
  const render::ViewBlock view =
      render::view_block(camera, ellipsoid, air_, sun_, render::near_distance(ellipsoid, above_m_));
  view_.upload(0, &view, sizeof(view));
  view_.bind_base(GL_UNIFORM_BUFFER, 0);
  if (sky_) sky_->prepare();
  render::begin_ground(target, cull_faces_, background_.value_or(glm::vec3(0.0f)));
  ground_.draw(seen);
  if (sky_) sky_->draw(view, 0, render::Serving::kItsSet);
  stats_.triangles += ground_.triangles();
  stats_.upload_bytes = ground_.upload_bytes();
  stats_.gpu_bytes = ground_.gpu_bytes();
  stats_.finest_level =
      levels().empty() ? 0 : static_cast<int>(*std::min_element(levels().begin(), levels().end()));
}

}  // namespace globe::flat
