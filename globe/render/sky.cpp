#include "globe/render/sky.h"

#include <epoxy/gl.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <string>

#include "globe/render/air.h"

namespace globe::render {
namespace {

constexpr int kCapSides = 64;  ///< of the polygon around a disc of the sky
constexpr float kOutside =
    1.05f;  ///< radii of the air: from nearer the disc of air would be as good as the screen
constexpr float kHighestAir = 100.0f;  ///< km: of the plain air and of any that takes its place
constexpr float kSunRadius = 0.0047f;  ///< radians, rounded up: sky.frag draws the disc's edge

gl::ProgramSources sources_of(const char* fragment_shader, int steps) {
  gl::ProgramSources sources;
  sources.files = {"sky.vert", fragment_shader};
  sources.defines = {"CAP_SIDES " + std::to_string(kCapSides), "SKY_STEPS " + std::to_string(steps)};
  return sources;
}

/// A disc of the sky about a direction of round space, by the tangent of its radius as seen from the eye.
glm::vec4 cap_around(const glm::vec3& axis, float tangent) {
  // The polygon's sides, not its corners, touch the disc.
  return {axis, tangent / std::cos(glm::pi<float>() / kCapSides)};
}

}  // namespace

Sky::Sky(bool air, const AirSteps& steps, const EffectShaders& effects)
    : texels_(steps.map),
      array_(gl::VertexArray::create()),
      program_(sources_of("sky.frag", steps.sky), effects) {
  if (!air) return;
  gl::ProgramSources sources = sources_of("sky_map.frag", steps.sky);
  sources.defines.insert(sources.defines.end(), effects.defines().begin(), effects.defines().end());
  sources.reader = effects.reader();
  map_program_ = gl::Program(sources);
  map_ = gl::Framebuffer(texels_.x, texels_.y, {1, GL_RGBA16F, GL_DEPTH_COMPONENT32F});
  map_.set_color_filter(GL_LINEAR);
}

void Sky::prepare() {
  if (!map_program_) return;
  map_.bind();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  array_.bind();
  map_program_->use();
  map_program_->set(0, glm::vec2(texels_));
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Sky::draw(const ViewBlock& view, int active, Serving serving) {
  glDisable(GL_CULL_FACE);
  glDepthFunc(GL_GEQUAL);
  glDepthMask(GL_FALSE);
  array_.bind();
  if (map_program_) map_.color().bind(4);
  const gl::Program& program = program_.for_active(active, serving);
  program.use();
  program.set(0, glm::vec2(texels_));

  const glm::vec3 eye(view.eye_km);
  const float distance = glm::length(eye);
  const float top = view.eye_km.w + kHighestAir;
  if (map_program_ && distance <= kOutside * top) {
    draw_cap(program, glm::vec4(0.0f));
  } else {
    if (map_program_)
      draw_cap(program, cap_around(-eye / distance, top / std::sqrt((distance - top) * (distance + top))));
    const glm::vec3 sun =
        glm::normalize(glm::vec3(view.sun) * glm::vec3(view.rounding.x, view.rounding.x, view.rounding.y));
    draw_cap(program, cap_around(sun, std::tan(kSunRadius)));
  }
  glDepthMask(GL_TRUE);
}

/// All of the screen for a cap of no size.
void Sky::draw_cap(const gl::Program& program, const glm::vec4& cap) const {
  program.set(1, cap);
  if (cap.w == 0.0f)
    glDrawArrays(GL_TRIANGLES, 0, 3);
  else
    glDrawArrays(GL_TRIANGLE_FAN, 0, kCapSides + 2);
}

}  // namespace globe::render
