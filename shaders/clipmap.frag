#include "lib/ground_pixel.glsl"
#include "lib/lit_ground.glsl"
#include "lib/shown_light.glsl"
#ifdef EFFECTS
#include "effects.glsl"  // what the effects at work add, put together by render::EffectShaders
#endif

layout(location = 3) uniform vec4 overlay;  // colour and share of it, for wire-frames and tints
layout(location = 4) uniform int show;      // 0 the ground, 1 levels, 2 patches, 3 normals

out vec4 color;

vec3 level_tint(float level) {
  float hue = level * 0.381966;
  return clamp(abs(fract(hue + vec3(0.0, 0.667, 0.333)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

void main() {
#ifdef ROOM
  // As far as a pixel inside the room both grounds are drawn: between them is no gap, whatever rounding does.
  if (all(greaterThan(shading.in_room, fwidth(shading.in_room)))) discard;
#endif
  vec4 lit = at_pixel(lit_ground_of);
#ifdef EFFECTS
  Place place = place_at(shading.relative, shading.height, shading.left);
  vec3 sunlight = shading.sunlight;
  vec3 skylight = shading.skylight;
  dim_by_effects(sunlight, skylight, place);
  vec3 light = ground_light(lit, sunlight, skylight);
#ifdef GLINT
  light += at_pixel(water_of).r * shading.glint * sunlight;
#endif
  light = through_effects(added_by_effects(light, place) + shading.haze, place);
#else
  vec3 light = ground_light(lit, shading.sunlight, shading.skylight) + shading.haze;
#ifdef GLINT
  light += at_pixel(water_of).r * shading.glint * shading.sunlight;
#endif
#endif
  vec3 shown = shown_light(light);
#ifdef SHOW
  if (show == 1) shown = mix(shown, level_tint(layers.z), 0.45);
  if (show == 2) shown = mix(shown, level_tint(layers.z * 7.0 + layers.x), 0.45);
  if (show == 3) shown = lit.rgb;
  shown = mix(shown, overlay.rgb, overlay.a);
#endif
  color = vec4(shown, 1.0);
}
