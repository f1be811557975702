#include "lib/lit_ground.glsl"
#include "lib/shown_light.glsl"

layout(binding = 2) uniform sampler2D lit_ground_of;
layout(location = 4) uniform vec4 overlay;  // colour and share of it, for wire-frames
layout(location = 5) uniform int show;      // 0 the ground, 1 levels, 2 patches, 3 normals

in Shading {
  centroid vec3 sunlight;
  centroid vec3 skylight;
  centroid vec3 haze;
  vec2 texel;
  vec2 plane;
} shading;
flat in vec2 level_and_number;

out vec4 color;

vec3 tint(float number) {
  float hue = number * 0.381966;
  return clamp(abs(fract(hue + vec3(0.0, 0.667, 0.333)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

void main() {
  vec4 lit = texture(lit_ground_of, shading.texel);
  vec3 shown = shown_light(ground_light(lit, shading.sunlight, shading.skylight) + shading.haze);
  if (show == 1) shown = mix(shown, tint(level_and_number.x), 0.45);
  if (show == 2) shown = mix(shown, tint(level_and_number.y * 7.0), 0.45);
  if (show == 3) shown = lit.rgb;
  color = vec4(mix(shown, overlay.rgb, overlay.a), 1.0);
}
