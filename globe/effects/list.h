#pragma once

#include <span>
#include <vector>

#include "globe/effects/entry.h"
#include "globe/render/effect_shaders.h"

namespace globe::effects {

/// The effects that there are: the lines of list.def.
std::span<const EffectEntry> all_effects();

/// The same for scene::read_scene.
std::vector<scene::EffectKind> effect_kinds();

/// Whether a scene asks for an effect that draws the sea: its planet's sea floor has to be bare.
bool draws_sea(const scene::Scene& scene);

/// Makes what a scene asks for, in its order. Throws Error of one line, "FILE:LINE: effects.NAME: ...", for
/// what the planet cannot have and for an effect named twice.
std::vector<render::NamedEffect> make_effects(const scene::Scene& scene, const planet::Surface& surface);

}  // namespace globe::effects
