#include "globe/render/tone.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace globe::render {
namespace shader {

using namespace glm;

#include "shaders/lib/tone.glsl"

}  // namespace shader

glm::vec3 tone_mapped(const glm::vec3& light) { return shader::tone_mapped(light); }

}  // namespace globe::render
