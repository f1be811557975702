// Vertices that stand at their heights over a surface between knots. For clipmap.vert: `instance` is the patch, `window` the
// windows' size.
#include "lib/patch_surface.glsl"

layout(binding = 0) uniform sampler2DArray heights;
layout(binding = 1) uniform sampler2DArray knots;  // two layers a layer: surface, normals (globe/clipmap/patch_surface.h)

// A patch: its corner 0 from the window's first node, and which way the cells go from there, 1 or -1.
struct Patch {
  ivec2 corner;
  int turn;
};

// The knot so many knots from the corner. kind: 0 surface, 1 normal.
vec3 knot_of(Patch of, ivec2 ab, Slot slot, int kind) {
  ivec2 texel = torus_texel(of.corner + of.turn * KNOT_STEP * ab, slot.torus.xy, window.x) / KNOT_STEP;
  return texelFetch(knots, ivec3(texel, 2 * slot.torus.z + kind), 0).xyz;
}

vec4 vertex_of(Patch of, ivec2 ab, Slot slot) {
  const ivec2 corner_1 = ivec2(KNOTS_A_PATCH, 0);
  const ivec2 corner_2 = ivec2(0, KNOTS_A_PATCH);
  vec3 share = corner_shares(ab, window.w);
  precise vec3 surface =
      between_corners(share, knot_of(of, ivec2(0), slot, 0), knot_of(of, corner_1, slot, 0), knot_of(of, corner_2, slot, 0));
#if KNOTS_A_PATCH == 2
  surface += bulge(share, knot_of(of, ivec2(1, 1), slot, 0), knot_of(of, ivec2(0, 1), slot, 0), knot_of(of, ivec2(1, 0), slot, 0));
#endif
  vec3 normal =
      between_corners(share, knot_of(of, ivec2(0), slot, 1), knot_of(of, corner_1, slot, 1), knot_of(of, corner_2, slot, 1));
  ivec2 texel = torus_texel(of.corner + of.turn * ab, slot.torus.xy, window.x);
  float height = texelFetch(heights, ivec3(texel, slot.torus.z), 0).x;
  return vec4(raised(surface, normal, height), height);
}

// Vertex (a, b) of the patch: metres from the level's anchor, and height.
vec4 fine_vertex(ivec2 ab, Slot slot) { return vertex_of(Patch(instance.xy, instance.z), ab, slot); }

// Where it stands at a morph factor of 1: halfway between the ends of the edge that it halves.
vec4 coarse_vertex(ivec2 ab, Slot slot) {
  Patch of = Patch(instance.xy, instance.z);
  ivec2 odd = ab & 1;
  ivec2 along = odd == ivec2(1) ? ivec2(1, -1) : odd;
  precise vec4 middle = 0.5 * (vertex_of(of, ab - along, slot) + vertex_of(of, ab + along, slot));
  return middle;
}

// The coarser level's vertex in its place, from that level's anchor: on an edge of the coarser patch that holds this one.
vec4 vertex_on_rim(ivec2 ab, Slot slot, Slot coarse) {
  ivec2 from_coarse = instance.xy + slot.coarse.xy;
  ivec2 square = from_coarse / window.w - (instance.z < 0 ? 1 : 0);
  ivec2 odd = square & 1;
  int turn = odd.x + odd.y == 1 ? instance.z : 1 - (odd.x + odd.y);
  Patch of = Patch((square / 2 + (turn < 0 ? 1 : 0)) * window.w, turn);
  return vertex_of(of, turn * ((from_coarse + instance.z * ab) / 2 - of.corner), coarse);
}
