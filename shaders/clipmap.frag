#include "lib/lit_ground.glsl"
#include "lib/tone.glsl"
#ifdef EFFECTS
#include "effects.glsl"  // what the effects at work add, put together by render::EffectShaders
#endif

layout(binding = 2) uniform sampler2DArray lit_ground_of;
#ifdef GLINT
layout(binding = 3) uniform sampler2DArray water_of;
#endif

layout(location = 3) uniform vec4 overlay;  // colour and share of it, for wire-frames and tints
layout(location = 4) uniform int show;      // 0 the ground, 1 levels, 2 patches, 3 normals

in Shading {
  vec3 sunlight;
  vec3 skylight;
  vec3 haze;
#ifdef SHADE_FINE
  vec2 texel;
#endif
#ifdef SHADE_COARSE
  vec2 coarse_texel;
#endif
#if defined(SHADE_FINE) && defined(SHADE_COARSE)
  float share;
#endif
#ifdef GLINT
  float glint;
#endif
#ifdef EFFECTS
  vec3 relative;
  float height;
  vec3 left;
#endif
} shading;
flat in vec3 layers;  // fine, coarse, level

out vec4 color;

vec3 level_tint(float level) {
  float hue = level * 0.381966;
  return clamp(abs(fract(hue + vec3(0.0, 0.667, 0.333)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

// One look-up where one level is shown, two where one turns into the other.
vec4 at_pixel(sampler2DArray values) {
#if defined(SHADE_FINE) && defined(SHADE_COARSE)
  return mix(texture(values, vec3(shading.texel, layers.x)), texture(values, vec3(shading.coarse_texel, layers.y)), shading.share);
#elif defined(SHADE_COARSE)
  return texture(values, vec3(shading.coarse_texel, layers.y));
#else
  return texture(values, vec3(shading.texel, layers.x));
#endif
}

void main() {
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
