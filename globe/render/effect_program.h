#pragma once

#include <map>
#include <optional>

#include "globe/gl/program.h"
#include "globe/render/effect_shaders.h"

namespace globe::render {

/// A program that effects have parts in, compiled anew for each set of them that is active in some view.
///
/// A program for one set has nothing in it of the others. A single program would pass over them by a branch
/// on a uniform, but in software that costs what both sides cost: llvmpipe computes both and chooses. That
/// program serves frames in real time until their set has been met, since compiling would stall them.
class EffectProgram {
 public:
  EffectProgram() = default;
  /// Compiles nothing yet.
  /// @param sources  reader and defines of the effects are added
  /// @param effects  must outlive this
  EffectProgram(gl::ProgramSources sources, const EffectShaders& effects);

  /// The program for a view, its uniform `active_effects` set where it has one.
  ///
  /// @param active  effects of the view, as EffectShaders has it
  const gl::Program& for_active(int active, Serving serving);

 private:
  gl::Program compiled_for(std::optional<int> set) const;

  gl::ProgramSources sources_;
  const EffectShaders* effects_ = nullptr;
  std::map<int, gl::Program> sets_;
  std::optional<gl::Program> any_;
};

}  // namespace globe::render
