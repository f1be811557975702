#pragma once

#include <glm/vec3.hpp>

namespace globe::render {

/// Share of sunlight that reaches a height (km) when the sun stands at a zenith angle; the very code of
/// shaders/lib/atmosphere.glsl, compiled here.
glm::vec3 sun_transmittance(float height_km, float cos_sun, float ground_radius_km);

/// Height above which there is no air, km.
float air_top_km();

}  // namespace globe::render
