#pragma once

#include <memory>

#include "globe/clipmap/patch.h"
#include "globe/clipmap/stream.h"
#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/planet/surface.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"

namespace bench {

/// A view of the built-in planet with everything resident, and what the renderer would draw of it.
struct GroundScene {
  /// @param above_m    height above ground at the scenic place
  /// @param pitch_deg  -90 down, 0 level
  GroundScene(int detail, double above_m, double pitch_deg);

  /// Clears the picture and binds what every way of drawing needs.
  void begin_frame() const;

  std::shared_ptr<const globe::planet::Surface> surface;
  globe::clipmap::Settings settings;
  globe::clipmap::PatchMesh mesh;
  globe::render::ClipmapTextures textures;
  std::shared_ptr<const globe::clipmap::ClipmapState> state;
  globe::render::DrawList list;
  globe::gl::Buffer view, slots;
  globe::gl::Framebuffer target{1280, 720};
};

}  // namespace bench
