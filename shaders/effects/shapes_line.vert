// A box around a piece of a line on the ground (effects::Arc): as high as the ground may be, as wide as the line on the screen.
#include "lib/view.glsl"

layout(location = 0) in vec4 arc_a;
layout(location = 1) in vec4 arc_b;
layout(location = 2) in vec4 arc_up_a;
layout(location = 3) in vec4 arc_up_b;
layout(location = 4) in vec4 arc_across;
layout(location = 5) in vec4 arc_along;
layout(location = 1) uniform vec4 sizes;  // a pixel at distance 1; pixels beyond the line's own half width; width and height of the picture

flat out vec4 across;
flat out vec4 along;
flat out vec2 size;  // length in metres, half width in pixels

void main() {
  // A box as one strip of 14 corners.
  int corner = 1 << gl_VertexID;
  bool at_b = (0x287a & corner) != 0;
  bool high = (0x02af & corner) != 0;
  float side = (0x31e3 & corner) != 0 ? 1.0 : -1.0;
  vec3 up = at_b ? arc_up_b.xyz : arc_up_a.xyz;
  vec3 at = (at_b ? arc_b.xyz : arc_a.xyz) + up * (high ? arc_b.w : arc_a.w);
  float half_width = arc_up_a.w + sizes.y;
  float around = (half_width + 2.0) * sizes.x * length(at);
  at += around * (arc_across.xyz * side + arc_along.xyz * (at_b ? 1.0 : -1.0) + up * (high ? 1.0 : -1.0));
  across = arc_across;
  along = arc_along;
  size = vec2(arc_up_b.w, half_width);
  gl_Position = view.clip_from_relative * vec4(at, 1.0);
}
