#include "lib/view.glsl"

layout(location = 1) uniform vec4 cap;  // axis in round space, tangent of the radius; 0: the whole screen

out vec3 ray;

// At infinity, where reversed depth is 0.
void main() {
  if (cap.w == 0.0) {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    ray = view.forward.xyz + corner.x * view.right.xyz + corner.y * view.up.xyz;
    gl_Position = vec4(corner, 0.0, 1.0);
    return;
  }
  // A fan: the axis, then the corners of a regular polygon around it.
  vec3 aside = normalize(abs(cap.z) < 0.9 ? vec3(-cap.y, cap.x, 0.0) : vec3(0.0, cap.z, -cap.y));
  vec3 ahead = cross(cap.xyz, aside);
  float turn = 6.2831853 / CAP_SIDES * float(gl_VertexID - 1);
  float out_from_axis = gl_VertexID == 0 ? 0.0 : cap.w;
  vec3 direction = cap.xyz + out_from_axis * (cos(turn) * aside + sin(turn) * ahead);
  ray = direction / view.rounding.xxy;
  gl_Position = view.clip_from_relative * vec4(ray, 0.0);
  gl_Position.z = 0.0;
}
