#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/texture.h"
#include "globe/gl/vertex_array.h"

namespace app {

/// How much a frame of RawGl draws. Triangles come in blocks of 2048; counts are rounded up to whole blocks,
/// those on the screen further to a full rectangle of blocks.
struct RawGlLoad {
  int width = 1280;
  int height = 720;
  int triangles_on_screen = 70000;
  int triangles_off_screen = 0;  ///< drawn all the same, so that the driver has to clip them away
};

/// The yardstick for a terrain renderer (benchmark fly.raw_gl): what OpenGL itself takes, on this machine and
/// now, for the bare picture of a height field of so many triangles. One draw and one uniform for each block
/// of 32x32 cells, a height fetched in the vertex shader for each vertex, the whole screen covered once, lit,
/// with one bilinear colour look-up a pixel, a sky-coloured clear and a 32-bit float depth buffer before it.
class RawGl {
 public:
  /// Needs a current context, here and to draw.
  explicit RawGl(const RawGlLoad& load);

  /// Draws a frame and waits until it is done.
  void operator()();

  int triangles_on_screen() const;
  int triangles_off_screen() const;
  const globe::gl::Framebuffer& framebuffer() const { return framebuffer_; }

 private:
  void make_field();
  void make_mesh();

  glm::ivec2 blocks_;  ///< columns and rows on the screen
  int blocks_off_screen_;
  globe::gl::Framebuffer framebuffer_;
  globe::gl::Program program_;
  globe::gl::Texture heights_, colors_;
  globe::gl::Buffer indices_;
  globe::gl::VertexArray mesh_;
  std::vector<glm::ivec4> draws_;  ///< the uniform `block` of each
};

}  // namespace app
