// A triangle that covers the half of a picture on one side of a line, for app/accuracy/sample_studies.cpp.
layout(location = 0) uniform vec4 edge;  // unit normal, distance of the line along it from the middle, pixels; w: half the width

void main() {
  vec2 on_line = edge.xy * edge.z;
  vec2 along = vec2(-edge.y, edge.x);
  float reach = 8.0 * edge.w;
  vec2 corner = gl_VertexID == 0 ? on_line + along * reach : gl_VertexID == 1 ? on_line - along * reach : on_line - edge.xy * reach;
  gl_Position = vec4(corner / edge.w, 0.5, 1.0);
}
