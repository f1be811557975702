#pragma once

#include <glm/vec4.hpp>
#include <optional>

#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/air.h"
#include "globe/render/effect_program.h"
#include "globe/render/view_block.h"

namespace globe::render {

/// The sky and the sun behind the ground.
///
/// From inside the air the sky is all that the ground leaves of the screen. From space it is a disc as wide
/// as the air, and the sun one of its own: between them space stays black without a pixel being computed.
class Sky {
 public:
  /// A GL context must be current and stay so; the effects must, too.
  Sky(bool air, const AirSteps& steps, const EffectShaders& effects);

  /// Fills the map of the sky as seen from the eye; changes the bound framebuffer. The view's block must be
  /// bound.
  void prepare();

  /// Draws what lies at infinity where depth is still that of infinity.
  /// @param active, serving  as EffectProgram has them
  void draw(const ViewBlock& view, int active, Serving serving);

 private:
  void draw_cap(const gl::Program& program, const glm::vec4& cap) const;

  glm::ivec2 texels_;  ///< of the map
  gl::VertexArray array_;
  EffectProgram program_;
  std::optional<gl::Program> map_program_;  ///< none where there is no air
  gl::Framebuffer map_;
};

}  // namespace globe::render
