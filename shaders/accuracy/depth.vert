// A plane across the view, for app/accuracy/depth_scheme.cpp.
layout(location = 0) uniform vec2 depth_row;  // clip z = x * distance + y
layout(location = 1) uniform float distance;  // along the view axis, metres

out float w;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner * distance, depth_row.x * distance + depth_row.y, distance);
  w = distance;
}
