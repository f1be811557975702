// A colour that costs about what ground does (lib/tone.glsl), and depth where the scheme wants it written.
#include "lib/tone.glsl"

layout(location = 2) uniform float shade;
#ifdef LOGARITHMIC
layout(location = 3) uniform float log_far;  // log2(1 + far)
#endif

in float w;
out vec4 color;

void main() {
#ifdef LOGARITHMIC
  gl_FragDepth = log2(1.0 + w) / log_far;
#endif
  color = vec4(shade, tone_mapped(vec3(fract(gl_FragCoord.xy * 0.01), shade)).xy, 1.0);
}
