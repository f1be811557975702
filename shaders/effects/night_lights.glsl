// Lamps of towns at night (globe/effects/night_lights.cpp).
#include "lib/lat_long.glsl"
#include "lib/place.glsl"
#include "lib/view.glsl"

layout(std140, binding = NIGHT_LIGHTS_BLOCK) uniform NightLights {
  vec4 lamps;  // light of white, brightness where lamps begin, sines of the sun's height where they begin to show and all do
  vec4 view;   // size of a pixel (radians)
} night_lights;
layout(binding = NIGHT_LIGHTS_UNIT) uniform sampler2D night_lights_map;

vec3 night_lights_add(vec3 light, Place place) {
  float dark = smoothstep(night_lights.lamps.z, night_lights.lamps.w, dot(place.up, view.sun.xyz));
  float footprint = length(place.relative) * 1e-3 / view.eye_km.w * night_lights.view.x;
  vec3 lamps = textureLod(night_lights_map, lat_long_place(place.up), lat_long_level(night_lights_map, footprint)).rgb;
  float brightness = max(lamps.r, max(lamps.g, lamps.b));
  float above = max(brightness - night_lights.lamps.y, 0.0) / (1.0 - night_lights.lamps.y);
  return light + lamps * (above / max(brightness, 1e-4) * dark * night_lights.lamps.x) * place.left;
}
