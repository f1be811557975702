// Fog by distance and height (globe/effects/fog.cpp).
#ifndef OUT
#define OUT(type) out type
#endif
#include "lib/atmosphere.glsl"
#include "lib/exponential_layer.glsl"
#include "lib/view.glsl"

layout(std140, binding = FOG_BLOCK) uniform Fog {
  vec4 color;  // albedo; w: extinction per metre at the base
  vec4 layer;  // base (metres above the ellipsoid), scale height, height of the eye above the base, radius of the planet; metres
} fog;

// What the fog shines with where the sun stands so.
vec3 fog_light(float cos_sun) {
  vec3 sun = vec3(max(cos_sun, 0.0));
  if (view.rounding.z > 0.0) sun = sun * sun_transmittance(0.0, cos_sun, view.eye_km.w) + sky_irradiance(0.0, cos_sun);
  return fog.color.rgb * sun * (view.sun.w * view.rounding.w * 0.3183099);
}

vec3 fog_through(vec3 light, vec3 relative_m) {
  vec3 ray = relative_m * view.rounding.xxy;
  float away = length(ray);
  vec3 direction = ray / max(away, 1e-6);
  float eye_radius = length(view.eye_km.xyz);
  float rise = dot(view.eye_km.xyz, direction) / eye_radius;
  float lowest = clamp(-rise * eye_radius * 1e3, 0.0, away);
  vec3 place = view.eye_km.xyz + direction * (lowest * 1e-3);
  float radius = length(place);
  float scale = fog.layer.y;
  float depth;
  if (lowest == 0.0) {
    depth = layer_depth(fog.layer.z, max(rise, 0.0), away, scale, fog.layer.w);
  } else {
    // Near by the height comes from the eye's, which is exact; far off from the place's, rounded to half a metre.
    float near = fog.layer.z + rise * lowest + (1.0 - rise * rise) * lowest * lowest / (2.0 * fog.layer.w);
    float low = lowest < 2e4 ? near : (radius - view.eye_km.w) * 1e3 - fog.layer.x;
    float climb = max(-dot(place, direction) / radius, 0.0);
    depth = layer_depth(low, climb, lowest, scale, fog.layer.w) + layer_depth(low, climb, away - lowest, scale, fog.layer.w);
  }
  float left = exp(-fog.color.w * depth);
  return mix(fog_light(dot(place, view.sun.xyz) / radius), light, left);
}
