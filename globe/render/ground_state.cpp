#include "globe/render/ground_state.h"

#include <epoxy/gl.h>

namespace globe::render {

void begin_ground(const gl::Framebuffer& picture, bool cull_faces, const glm::vec3& background) {
  picture.bind();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  if (cull_faces) {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
  } else {
    glDisable(GL_CULL_FACE);
  }
  picture.clear_color(background.r, background.g, background.b, 1.0f);
  picture.clear_depth(0.0f);
}

void draw_wired(bool wireframe, const std::function<void(const glm::vec4& overlay)>& draw) {
  if (!wireframe) return draw(glm::vec4(0.0f));
  draw(glm::vec4(0.0f, 0.0f, 0.0f, 0.35f));
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(1.0f, 1.0f);
  draw(glm::vec4(1.0f, 1.0f, 1.0f, 0.75f));
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

}  // namespace globe::render
