#pragma once

#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"

namespace globe::render {

/// A picture of light (RGBA half floats), for passes that add to each other, and the pass that shows it.
class LightPicture {
 public:
  /// A GL context must be current and stay so.
  LightPicture();

  /// To draw into in place of `target`: of its size and samples.
  const gl::Framebuffer& in_place_of(const gl::Framebuffer& target);
  /// Tones it into the target; depth as it is.
  void show(const gl::Framebuffer& target);

  std::size_t gpu_bytes() const;

 private:
  gl::Framebuffer light_;
  gl::Program program_;
  gl::VertexArray array_;
};

}  // namespace globe::render
