#include "lib/tone.glsl"
#include "lib/view.glsl"

layout(binding = 2) uniform sampler2DArray albedos;
layout(binding = 3) uniform sampler2DArray normals;

layout(location = 3) uniform vec4 overlay;  // colour and share of it, for wire-frames and tints
layout(location = 4) uniform int show;      // 0 the ground, 1 levels, 2 patches, 3 normals

in Shading {
  vec3 lit;
  vec3 sunlight;
  vec3 skylight;
  vec3 haze;
  vec2 texel;
#ifdef MORPH
  vec2 coarse_texel;
  float alpha;
#endif
  float glint;
} shading;
flat in ivec3 layers;

out vec4 color;

vec3 level_tint(int level) {
  float hue = float(level) * 0.381966;
  return clamp(abs(fract(hue + vec3(0.0, 0.667, 0.333)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

void main() {
  vec4 ground = texture(albedos, vec3(shading.texel, float(layers.x)));
  vec2 slope = texture(normals, vec3(shading.texel, float(layers.x))).xy;
#ifdef MORPH
  ground = mix(ground, texture(albedos, vec3(shading.coarse_texel, float(layers.y))), shading.alpha);
  slope = mix(slope, texture(normals, vec3(shading.coarse_texel, float(layers.y))).xy, shading.alpha);
#endif
  slope = slope * (2.0 * 65535.0 / 65534.0) - 1.0;
  vec3 albedo = ground.rgb * ground.rgb;
  float up = sqrt(max(1.0 - dot(slope, slope), 0.0));
  float facing = up * shading.lit.x + slope.x * shading.lit.y + slope.y * shading.lit.z;
  // Ground below the sun's horizon is dark whatever its slope, with a penumbra as wide as the sun and the air make it.
  float risen = smoothstep(-0.03, 0.03, shading.lit.x);
  float sun = max(facing, 0.0) * risen;
  vec3 light = albedo * (shading.sunlight * sun + shading.skylight * (0.55 + 0.45 * up));
  light += ground.a * shading.glint * shading.sunlight;
  light += shading.haze;
  vec3 shown = tone_mapped(light * view.rounding.w);
#ifdef SHOW
  if (show == 1) shown = mix(shown, level_tint(layers.z), 0.45);
  if (show == 2) shown = mix(shown, level_tint(layers.z * 7 + layers.x), 0.45);
  if (show == 3) shown = vec3(slope * 0.5 + 0.5, up);
  shown = mix(shown, overlay.rgb, overlay.a);
#endif
  color = vec4(shown, 1.0);
}
