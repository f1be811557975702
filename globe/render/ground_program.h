#pragma once

#include "globe/gl/program.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"
#include "globe/render/effect_shaders.h"

namespace globe::render {

/// The program that draws patches of one look from such textures.
///
/// @param tinted  with the uniforms `overlay` and `show` of shaders/clipmap.frag
/// @param haze_steps  AirSteps::haze
gl::Program ground_program(const Look& look, const ClipmapTextures& textures, bool tinted, int haze_steps,
                           const EffectShaders& effects = {});

}  // namespace globe::render
