#pragma once

#include <glm/vec3.hpp>

namespace globe::render {

/// What the screen shows of scene light (at least 0), sRGB, 1 white; shaders/lib/tone.glsl, compiled here.
/// @approximation shading.tone
glm::vec3 tone_mapped(const glm::vec3& light);

/// Light that the screen shows as a colour (sRGB in [0, 1]), to a tenth of a step of eight bits.
glm::vec3 light_shown_as(const glm::vec3& color);

}  // namespace globe::render
