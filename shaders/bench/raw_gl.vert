// One 32x32-cell block of a height field, from gl_VertexID alone (app/raw_gl.h).

uniform mat4 clip_from_field;
uniform ivec4 block;       // x, y of its first node in the height field; x, y of its place, in cells
uniform vec2 field_cells;  // size of the field on the screen

layout(binding = 0) uniform sampler2D heights;

out vec3 field_position;
out vec2 color_uv;

void main() {
  ivec2 node = ivec2(gl_VertexID % NODES_PER_SIDE, gl_VertexID / NODES_PER_SIDE);
  float height = texelFetch(heights, block.xy + node, 0).r;
  vec2 place = vec2(block.zw + node) / field_cells;
  field_position = vec3(2.0 * place - 1.0, height);
  color_uv = place;
  gl_Position = clip_from_field * vec4(field_position, 1.0);
}
