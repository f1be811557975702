#include "globe/render/ground_program.h"

#include <string>

namespace globe::render {

gl::ProgramSources ground_sources(const Look& look, const ClipmapTextures& textures, bool tinted,
                                  int haze_steps, bool room) {
  gl::ProgramSources sources;
  sources.files = {"clipmap.vert", "clipmap.frag"};
  sources.defines = textures.defines();
  sources.defines.push_back("MAX_SLOTS " + std::to_string(kMaxSlots));
  sources.defines.push_back("HAZE_STEPS " + std::to_string(haze_steps));
  if (look.kind != Kind::kPlain) sources.defines.push_back("MORPH");
  if (look.kind == Kind::kRim) sources.defines.push_back("RIM");
  if (look.shading != Shading::kCoarse) sources.defines.push_back("SHADE_FINE");
  if (look.kind != Kind::kPlain && look.shading != Shading::kFine) sources.defines.push_back("SHADE_COARSE");
  if (look.shading == Shading::kGlint) sources.defines.push_back("GLINT");
  if (tinted) sources.defines.push_back("SHOW");
  if (room) sources.defines.push_back("ROOM");
  return sources;
}

}  // namespace globe::render
