// The water between an eye in it and all that it sees (globe/effects/underwater.cpp).
#ifndef OUT
#define OUT(type) out type
#endif
#include "lib/atmosphere.glsl"
#include "lib/view.glsl"

layout(std140, binding = UNDERWATER_BLOCK) uniform Underwater {
  vec4 color;       // albedo; w: depth of the eye, metres
  vec4 extinction;  // of a ray, per metre
  vec4 dimming;     // of daylight with depth, per metre
} underwater;

// Light that the water scatters toward the eye along a ray, where daylight fades with depth z as exp(-K z): the integral of
// c exp(-c s) exp(-K (z - rise s)).
vec3 underwater_through(vec3 light, vec3 relative_m) {
  float away = min(length(relative_m), 1e5);
  vec3 up = normalize(view.eye_km.xyz * view.rounding.xxy);
  float rise = dot(relative_m, up) / max(length(relative_m), 1e-6);
  float cos_sun = dot(up, view.sun.xyz);
  vec3 day = vec3(max(cos_sun, 0.0));
  if (view.rounding.z > 0.0) day = day * sun_transmittance(0.0, cos_sun, view.eye_km.w) + sky_irradiance(0.0, cos_sun);
  day *= view.sun.w * view.rounding.w * 0.3183099;
  vec3 lost = underwater.extinction.rgb - underwater.dimming.rgb * rise;
  vec3 scattered = underwater.extinction.rgb / lost * (1.0 - exp(-lost * away));
  return light * exp(-underwater.extinction.rgb * away) +
         underwater.color.rgb * day * exp(-underwater.dimming.rgb * underwater.color.w) * scattered;
}
