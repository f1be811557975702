#pragma once

#include "globe/gl/program.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"

namespace globe::render {

/// What the program that draws patches of one look from such textures is built from, effects left out.
///
/// @param tinted  with the uniforms `overlay` and `show` of shaders/clipmap.frag
/// @param haze_steps  AirSteps::haze
/// @param room    with the uniforms `room_axes` and `eye_in_room` of shaders/clipmap.vert
gl::ProgramSources ground_sources(const Look& look, const ClipmapTextures& textures, bool tinted,
                                  int haze_steps, bool room = false);

}  // namespace globe::render
