#include "lib/lit_ground.glsl"
#include "lib/shown_light.glsl"
#ifdef EFFECTS
#include "effects.glsl"
#endif

layout(binding = 2) uniform sampler2D lit_ground_of;
#ifdef GLINT
layout(binding = 5) uniform sampler2D water_of;
#endif
layout(location = 4) uniform vec4 overlay;  // colour and share of it, for wire-frames
layout(location = 5) uniform int show;      // 0 the ground, 1 levels, 2 patches, 3 normals
#ifdef MATERIAL
layout(binding = 3) uniform sampler2D tile_of;  // brightness, 1 at 128/255
layout(location = 6) uniform vec4 u_row;
layout(location = 7) uniform vec4 v_row;
#ifdef MASKED
layout(binding = 0) uniform sampler2D mask_of;
#endif
#endif
#ifdef CLOUD_SHADOWS
layout(binding = 1) uniform sampler2D clouds_of;
layout(location = 8) uniform vec4 clouds;  // texture coordinate of the plane's origin, per metre, darkest
#endif

in Shading {
  centroid vec3 sunlight;
  centroid vec3 skylight;
  centroid vec3 haze;
  vec2 texel;
  vec2 plane;
#ifdef GLINT
  centroid float glint;
#endif
#ifdef EFFECTS
  centroid vec3 relative;
  centroid float height;
  centroid vec3 left;
#endif
} shading;
flat in vec2 level_and_number;

out vec4 color;

vec3 tint(float number) {
  float hue = number * 0.381966;
  return clamp(abs(fract(hue + vec3(0.0, 0.667, 0.333)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

void main() {
  vec4 lit = texture(lit_ground_of, shading.texel);
  vec3 sunlight = shading.sunlight;
#ifdef CLOUD_SHADOWS
  sunlight *= 1.0 - clouds.w * texture(clouds_of, shading.plane * clouds.z + clouds.xy).r;
#endif
  vec3 skylight = shading.skylight;
#ifdef EFFECTS
  Place at = place_at(shading.relative, shading.height, shading.left);
  dim_by_effects(sunlight, skylight, at);
#endif
  vec3 light = ground_light(lit, sunlight, skylight);
#ifdef GLINT
  light += texture(water_of, shading.texel).r * shading.glint * sunlight;
#endif
  float share = 1.0;
#ifdef MATERIAL
  vec4 place = vec4(shading.plane, 0.0, 1.0);
  light *= texture(tile_of, vec2(dot(place, u_row), dot(place, v_row))).r * (255.0 / 128.0);
#ifdef MASKED
  share = texture(mask_of, shading.texel).r;
#endif
#endif
#ifdef EFFECTS
  vec3 shown = shown_light(through_effects(added_by_effects(light, at) + shading.haze, at));
#else
  vec3 shown = shown_light(light + shading.haze);
#endif
  if (show == 1) shown = mix(shown, tint(level_and_number.x), 0.45);
  if (show == 2) shown = mix(shown, tint(level_and_number.y * 7.0), 0.45);
  if (show == 3) shown = lit.rgb;
  color = vec4(mix(shown, overlay.rgb, overlay.a), share);
}
