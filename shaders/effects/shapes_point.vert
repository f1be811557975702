// A disc at a place on the ground, seen where the ground drawn before it is not nearer (globe/effects/shapes.cpp).
#include "lib/view.glsl"

layout(binding = 0) uniform sampler2D depth;
layout(location = 0) in vec4 place;       // metres from the eye; w: radius in pixels
layout(location = 1) uniform vec4 sizes;  // width of the halo; width and height of the picture

out vec2 from_middle;  // pixels
flat out vec2 shown;   // radius, share that is seen

const float kTolerance = 1.02;  // of depth: the ground drawn may be off the place's own height
const int kAbove = 4;           // pixels: who stands on a crest is seen over it

void main() {
  vec4 at = view.clip_from_relative * vec4(place.xyz, 1.0);
  vec2 middle = (at.xy / at.w * 0.5 + 0.5) * sizes.yz;
  float own = view.clip_from_relative[3].z / at.w;
  float seen = 0.0;
  for (int k = 0; k < kAbove; ++k) {
    ivec2 texel = clamp(ivec2(middle) + ivec2(0, k), ivec2(0), ivec2(sizes.yz) - 1);
    seen += texelFetch(depth, texel, 0).r <= own * kTolerance ? 1.0 / float(kAbove) : 0.0;
  }
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  from_middle = corner * (place.w + sizes.x + 1.0);
  shown = vec2(place.w, seen);
  gl_Position = vec4((middle + from_middle) / sizes.yz * 2.0 - 1.0, 0.0, 1.0);
}
