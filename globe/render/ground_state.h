#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "globe/gl/framebuffer.h"

namespace globe::render {

/// Binds a picture and clears it for opaque ground: reversed depth, tested and written, nothing blended.
/// @param cull_faces  triangles that wind clockwise are left out
void begin_ground(const gl::Framebuffer& picture, bool cull_faces, const glm::vec3& background);

/// Draws triangles, or with `wireframe` darkened and their edges over them. `draw` is given a colour and the
/// share of it, for the fragment shader.
void draw_wired(bool wireframe, const std::function<void(const glm::vec4& overlay)>& draw);

}  // namespace globe::render
