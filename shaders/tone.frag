// The last pass of pictures that were drawn as light: the screen's colours, and depth as it is.
#include "lib/tone.glsl"

layout(binding = 0) uniform sampler2D light;
layout(binding = 1) uniform sampler2D depth;

out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  color = vec4(tone_mapped(max(texelFetch(light, pixel, 0).rgb, 0.0)), 1.0);
  gl_FragDepth = texelFetch(depth, pixel, 0).r;
}
