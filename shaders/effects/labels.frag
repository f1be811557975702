#include "lib/marked_light.glsl"

layout(binding = 0) uniform sampler2D texts;  // letters; letters and halo
layout(location = 1) uniform vec4 ink;        // colour as the screen shows it

in vec2 texel;
flat in float shown;

out vec4 color;

const vec3 kHalo = vec3(0.03, 0.04, 0.05);

void main() {
  vec2 cover = texelFetch(texts, ivec2(texel), 0).rg;
  float all = max(cover.g, cover.r);
  if (all == 0.0) discard;
  color = vec4(light_shown_as(mix(kHalo, ink.rgb, cover.r / all)), all * mix(0.8, 1.0, cover.r) * shown);
}
