// The air as tables have it, in place of lib/atmosphere.glsl (globe/effects/atmosphere.cpp).
layout(std140, binding = ATMOSPHERE_BLOCK) uniform Air {
  vec4 rayleigh;
  vec4 mie;
  vec4 ozone;
  vec4 bounds;
  vec4 mie_moments;
  vec4 sizes;  // of the tables: transmittance, moments; texels
} air;
layout(binding = ATMOSPHERE_UNIT) uniform sampler2D transmittance_table;
layout(binding = ATMOSPHERE_UNIT + 1) uniform sampler2DArray moments_table;

// Texel centres of the border stand for the ends of both ranges.
vec3 transmittance_texel(vec2 place) {
  return textureLod(transmittance_table, (place * (air.sizes.xy - 1.0) + 0.5) / air.sizes.xy, 0.0).rgb;
}

vec4 moments_texel(vec2 place, int layer) {
  return textureLod(moments_table, vec3((place * (air.sizes.zw - 1.0) + 0.5) / air.sizes.zw, float(layer)), 0.0);
}

#include "lib/scattering.glsl"

const float kAirTop = 100.0;  // km; mirrored by effects::AirModel

// Share of sunlight that reaches height h, its edge at the horizon as wide as the sun.
vec3 sun_transmittance(float h, float cos_sun, float ground) {
  float horizon = horizon_cosine(h);
  return sunlight_at(h, max(cos_sun, horizon)) * smoothstep(-0.00465, 0.00465, cos_sun - horizon);
}

vec3 sky_irradiance(float h, float cos_sun) { return skylight_at(h, cos_sun); }

// A texel of the sky's map: the light's logarithm, for dusk and the limb fade exponentially.
vec4 sky_light(vec3 eye, vec3 direction, float from, float to, vec3 sun, float ground, int steps) {
  vec3 left;
  return vec4(log2(max(air_radiance(eye, direction, from, to, sun, SKY_PANELS, false, left), vec3(1e-9))), 0.0);
}

vec3 with_mie(vec4 light, float cos_angle) { return exp2(vec3(light)); }

vec3 light_before(vec3 eye, vec3 direction, float from, float to, vec3 sun, float cos_sun_at_to, float ground, int steps,
                  out vec3 transmitted) {
  return air_radiance(eye, direction, from, to, sun, HAZE_PANELS, true, transmitted);
}
