#include "globe/render/tone.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace globe::render {
namespace shader {

using namespace glm;

#include "shaders/lib/tone.glsl"

}  // namespace shader

glm::vec3 tone_mapped(const glm::vec3& light) { return shader::tone_mapped(light); }

glm::vec3 light_shown_as(const glm::vec3& color) {
  // The curve falls a little right of 0, where it shows nothing; from there on it rises.
  glm::vec3 light(0.0f);
  for (int c = 0; c < 3; ++c) {
    float dark = 3.1e-4f, bright = 1e3f;
    for (int k = 0; k < 60 && color[c] > 0.0f; ++k) {
      const float middle = std::sqrt(dark * bright);
      (tone_mapped(glm::vec3(middle)).x < color[c] ? dark : bright) = middle;
    }
    light[c] = color[c] > 0.0f ? bright : 0.0f;
  }
  return light;
}

}  // namespace globe::render
