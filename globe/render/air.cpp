#include "globe/render/air.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace globe::render {
namespace shader {

using namespace glm;

#define OUT(type) type&
#include "shaders/lib/atmosphere.glsl"
#undef OUT

}  // namespace shader

glm::vec3 sun_transmittance(float height_km, float cos_sun, float ground_radius_km) {
  return shader::sun_transmittance(height_km, cos_sun, ground_radius_km);
}

float air_top_km() { return shader::kAirTop; }

}  // namespace globe::render
