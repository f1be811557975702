#pragma once

#include <cstdint>
#include <vector>

#include "globe/gl/texture.h"

namespace globe::gl {

/// What a Framebuffer is made of.
struct FramebufferFormat {
  int samples = 1;  ///< 1: no multi-sampling
  GLenum color = GL_RGBA8;
  GLenum depth = GL_DEPTH_COMPONENT32F;
};

/// A picture to draw into: one colour and one depth attachment.
///
/// With one sample both are textures that later passes may look up. With more, drawing goes into
/// renderbuffers and resolve() brings the picture into the textures; reading does so by itself. Multi-sampled
/// depth resolves to one of the samples.
class Framebuffer {
 public:
  Framebuffer() = default;
  Framebuffer(int width, int height, const FramebufferFormat& format = {});

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return format_.samples; }
  GLuint id() const { return drawn_.id(); }

  /// Directs drawing here, the viewport covering all of it. (glBindFramebuffer, glViewport)
  void bind() const;

  void clear_color(float red, float green, float blue, float alpha) const;
  /// 0 is infinitely far with reversed depth. Depth writes must be on (glDepthMask).
  void clear_depth(float depth) const;

  /// Brings a multi-sampled picture into the textures; nothing to do with one sample.
  /// (glBlitNamedFramebuffer)
  void resolve() const;

  const Texture& color() const { return color_; }
  /// How later passes look the colours up: GL_NEAREST (the default) or GL_LINEAR, borders clamped.
  void set_color_filter(GLenum filter) {
    color_.set_filter(filter, filter);
    color_.set_wrap(GL_CLAMP_TO_EDGE);
  }
  const Texture& depth() const { return depth_; }

  /// Finished pictures, top row first: RGBA bytes, RGBA floats, depth-buffer values. They wait for the GPU.
  std::vector<std::uint8_t> read_rgba8() const;
  std::vector<float> read_rgba_float() const;
  std::vector<float> read_depth() const;
  /// Depth-buffer value of one pixel of the picture resolved last, column from the left and row from the top.
  /// It waits for the GPU.
  float read_depth_at(int column, int row) const;
  /// What a finished picture is copied from, after resolve(): one sample.
  GLuint resolved_id() const { return readable().id(); }

 private:
  static void destroy(GLuint id);
  static void destroy_renderbuffer(GLuint id);
  using FramebufferName = Name<&Framebuffer::destroy>;
  using RenderbufferName = Name<&Framebuffer::destroy_renderbuffer>;

  static FramebufferName create();
  RenderbufferName attach_renderbuffer(GLenum attachment, GLenum format) const;
  const FramebufferName& readable() const { return samples() > 1 ? resolved_ : drawn_; }

  void read_rectangle(int x, int y, int width, int height, GLenum pixel_format, GLenum type,
                      void* pixels) const;
  template <class T>
  std::vector<T> read(GLenum pixel_format, GLenum type, std::size_t channels) const;

  int width_ = 0, height_ = 0;
  FramebufferFormat format_;
  Texture color_, depth_;
  FramebufferName drawn_, resolved_;
  RenderbufferName color_samples_, depth_samples_;
};

}  // namespace globe::gl
