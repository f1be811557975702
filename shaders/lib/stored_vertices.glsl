// Vertices whose positions lie in the windows. For clipmap.vert: `instance` is the patch, `window` the windows' size.
layout(binding = 0) uniform sampler2DArray positions;
layout(binding = 1) uniform sampler2DArray coarse_positions;

ivec3 vertex_texel(ivec2 node, Slot slot) {
#ifdef BRICK
  return ivec3(brick_texel(node, slot.torus.xy, BRICK), slot.torus.z);
#else
  return ivec3(torus_texel(node, slot.torus.xy, window.x), slot.torus.z);
#endif
}

// Vertex (a, b) of the patch: metres from the level's anchor, and height.
vec4 fine_vertex(ivec2 ab, Slot slot) {
  return texelFetch(positions, vertex_texel(instance.xy + instance.z * ab, slot), 0);
}

// Where it stands at a morph factor of 1.
vec4 coarse_vertex(ivec2 ab, Slot slot) {
  return texelFetch(coarse_positions, vertex_texel(instance.xy + instance.z * ab, slot), 0);
}

// The coarser level's vertex in its place, from that level's anchor.
vec4 vertex_on_rim(ivec2 ab, Slot slot, Slot coarse) {
  return texelFetch(positions, vertex_texel((instance.xy + instance.z * ab + slot.coarse.xy) / 2, coarse), 0);
}
