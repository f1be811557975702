#pragma once

#include <glm/vec3.hpp>

namespace globe::render {

/// What the screen shows of scene light (at least 0), sRGB, 1 white; shaders/lib/tone.glsl, compiled here.
/// @approximation shading.tone
glm::vec3 tone_mapped(const glm::vec3& light);

}  // namespace globe::render
