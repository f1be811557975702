#include "globe/render/light_picture.h"

#include <epoxy/gl.h>

namespace globe::render {

LightPicture::LightPicture() : array_(gl::VertexArray::create()) {
  gl::ProgramSources sources;
  sources.files = {"wide_view.vert", "tone.frag"};
  program_ = gl::Program(sources);
}

const gl::Framebuffer& LightPicture::in_place_of(const gl::Framebuffer& target) {
  if (light_.width() != target.width() || light_.height() != target.height() ||
      light_.samples() != target.samples())
    light_ = gl::Framebuffer(target.width(), target.height(),
                             {target.samples(), GL_RGBA16F, GL_DEPTH_COMPONENT32F});
  return light_;
}

void LightPicture::show(const gl::Framebuffer& target) {
  light_.resolve();
  target.bind();
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_ALWAYS);
  light_.color().bind(0);
  light_.depth().bind(1);
  array_.bind();
  program_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::size_t LightPicture::gpu_bytes() const {
  const auto samples = static_cast<std::size_t>(light_.samples());
  const std::size_t picture = light_.color().bytes() + light_.depth().bytes();
  return light_.width() == 0 ? 0 : picture * (samples > 1 ? samples + 1 : 1);
}

}  // namespace globe::render
