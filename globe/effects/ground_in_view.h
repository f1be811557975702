#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "globe/render/effect.h"

namespace globe::effects {

/// Height of the ground at a normal, about as finely as a view shows it from a distance, metres above the
/// ellipsoid; the sea's floor below it. Where frames do not wait, that of the ground at hand.
double ground_height(const render::EffectView& view, const glm::dvec3& u, double distance_m);

/// Lowest and highest ground of a planet as it is drawn, waves included, with room for what is synthesised
/// below its data.
glm::dvec2 drawn_heights(const planet::Surface& surface);

}  // namespace globe::effects
