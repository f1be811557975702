#include "globe/gl/framebuffer.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "globe/base/error.h"

namespace globe::gl {
namespace {

void flip_rows(void* pixels, std::size_t row_bytes, std::size_t rows) {
  auto* bytes = static_cast<std::byte*>(pixels);
  for (std::size_t top = 0; top < rows / 2; ++top) {
    std::byte* upper = bytes + top * row_bytes;
    std::swap_ranges(upper, upper + row_bytes, bytes + (rows - 1 - top) * row_bytes);
  }
}

void require_complete(GLuint framebuffer, int width, int height, int samples) {
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  throw Error("picture of " + std::to_string(width) + "x" + std::to_string(height) + " with " +
                  std::to_string(samples) + " samples",
              "the graphics driver refuses it (status " + std::to_string(status) + ")",
              "try a smaller size or --samples 1");
}

}  // namespace

void Framebuffer::destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
void Framebuffer::destroy_renderbuffer(GLuint id) { glDeleteRenderbuffers(1, &id); }

Framebuffer::FramebufferName Framebuffer::create() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return FramebufferName(id);
}

Framebuffer::RenderbufferName Framebuffer::attach_renderbuffer(GLenum attachment, GLenum format) const {
  GLuint renderbuffer = 0;
  glCreateRenderbuffers(1, &renderbuffer);
  RenderbufferName result(renderbuffer);
  glNamedRenderbufferStorageMultisample(renderbuffer, samples(), format, width_, height_);
  glNamedFramebufferRenderbuffer(drawn_.id(), attachment, GL_RENDERBUFFER, renderbuffer);
  return result;
}

Framebuffer::Framebuffer(int width, int height, const FramebufferFormat& format)
    : width_(width), height_(height), format_(format), drawn_(create()) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width < 1 || height < 1 || width > limit || height > limit) {
    throw Error("picture of " + std::to_string(width) + "x" + std::to_string(height),
                "this graphics driver draws up to " + std::to_string(limit) + " pixels a side",
                "give a size within that");
  }
  color_ = Texture::flat(format.color, width, height);
  depth_ = Texture::flat(format.depth, width, height);
  if (samples() > 1) {
    color_samples_ = attach_renderbuffer(GL_COLOR_ATTACHMENT0, format.color);
    depth_samples_ = attach_renderbuffer(GL_DEPTH_ATTACHMENT, format.depth);
    resolved_ = create();
    require_complete(drawn_.id(), width, height, samples());
  }
  glNamedFramebufferTexture(readable().id(), GL_COLOR_ATTACHMENT0, color_.id(), 0);
  glNamedFramebufferTexture(readable().id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
  require_complete(readable().id(), width, height, samples());
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  glViewport(0, 0, width_, height_);
}

void Framebuffer::clear_color(float red, float green, float blue, float alpha) const {
  const float value[4] = {red, green, blue, alpha};
  glClearNamedFramebufferfv(drawn_.id(), GL_COLOR, 0, value);
}

void Framebuffer::clear_depth(float depth) const {
  glClearNamedFramebufferfv(drawn_.id(), GL_DEPTH, 0, &depth);
}

void Framebuffer::resolve() const {
  if (samples() == 1) return;
  glBlitNamedFramebuffer(drawn_.id(), resolved_.id(), 0, 0, width_, height_, 0, 0, width_, height_,
                         GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

template <class T>
std::vector<T> Framebuffer::read(GLenum pixel_format, GLenum type, std::size_t channels) const {
  resolve();
  const std::size_t row = static_cast<std::size_t>(width_) * channels;
  std::vector<T> pixels(row * static_cast<std::size_t>(height_));
  read_rectangle(0, 0, width_, height_, pixel_format, type, pixels.data());
  flip_rows(pixels.data(), row * sizeof(T), static_cast<std::size_t>(height_));
  return pixels;
}

void Framebuffer::read_rectangle(int x, int y, int width, int height, GLenum pixel_format, GLenum type,
                                 void* pixels) const {
  // Reading is bound and put back, for want of a glReadPixels that names its framebuffer.
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, readable().id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(x, y, width, height, pixel_format, type, pixels);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
}

float Framebuffer::read_depth_at(int column, int row) const {
  float depth = 0;
  read_rectangle(column, height_ - 1 - row, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  return depth;
}

std::vector<std::uint8_t> Framebuffer::read_rgba8() const {
  return read<std::uint8_t>(GL_RGBA, GL_UNSIGNED_BYTE, 4);
}
std::vector<float> Framebuffer::read_rgba_float() const { return read<float>(GL_RGBA, GL_FLOAT, 4); }
std::vector<float> Framebuffer::read_depth() const { return read<float>(GL_DEPTH_COMPONENT, GL_FLOAT, 1); }

}  // namespace globe::gl
