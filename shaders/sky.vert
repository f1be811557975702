#include "lib/view.glsl"

out vec3 ray;

// One triangle over the screen at infinity, where reversed depth is 0.
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  ray = view.forward.xyz + corner.x * view.right.xyz + corner.y * view.up.xyz;
  gl_Position = vec4(corner, 0.0, 1.0);
}
