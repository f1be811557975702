#include "globe/render/ground_program.h"

#include <string>

namespace globe::render {
gl::Program ground_program(const Look& look, const ClipmapTextures& textures, bool tinted, int haze_steps,
                           const EffectShaders& effects) {
  gl::ProgramSources sources;
  sources.files = {"clipmap.vert", "clipmap.frag"};
  sources.reader = effects.reader();
  sources.defines = textures.defines();
  sources.defines.push_back("MAX_SLOTS " + std::to_string(kMaxSlots));
  sources.defines.push_back("HAZE_STEPS " + std::to_string(haze_steps));
  sources.defines.insert(sources.defines.end(), effects.defines().begin(), effects.defines().end());
  if (look.kind != Kind::kPlain) sources.defines.push_back("MORPH");
  if (look.kind == Kind::kRim) sources.defines.push_back("RIM");
  if (look.shading != Shading::kCoarse) sources.defines.push_back("SHADE_FINE");
  if (look.kind != Kind::kPlain && look.shading != Shading::kFine) sources.defines.push_back("SHADE_COARSE");
  if (look.shading == Shading::kGlint) sources.defines.push_back("GLINT");
  if (tinted) sources.defines.push_back("SHOW");
  return gl::Program(sources);
}

}  // namespace globe::render
