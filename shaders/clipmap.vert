#define OUT(type) out type
#include "lib/clipmap.glsl"
#include "lib/air_light.glsl"
#include "lib/lit_ground.glsl"
#include "lib/glint.glsl"
#include "lib/view.glsl"

// One layer of the windows: a level's share of one diamond. Mirrored by render::SlotBlock.
struct Slot {
  vec4 offset;     // anchor - camera, metres; w: fade of the level
  ivec4 torus;     // texel of the first node (i, j), layer of its vertices, slot of the coarser level in this diamond
  ivec4 images_a;  // nearest images of the nadir from the first node, 1/1024 cells
  ivec4 images_b;
  ivec4 coarse;    // first node - 2 * coarser slot's first node (i, j), level, layer of its shading
  vec4 shading;    // texture coordinate of the first node, and of a cell
};
layout(std140, binding = 1) uniform Slots { Slot slots[MAX_SLOTS]; };

layout(location = 0) in uvec2 local;     // cells from corner 0 of the patch
layout(location = 1) in ivec4 instance;  // corner 0 from the window's first node (i, j), ±1 for the half, slot

layout(location = 0) uniform ivec4 window;       // texels of the torus, morph begin, morph end, m
layout(location = 2) uniform int rim;            // bits 0-2: edges whose vertices are the coarser level's, 3-5: corners
#ifdef ROOM
layout(location = 5) uniform mat3 room_axes;     // in the world, columns: along the sides of the room, and up
layout(location = 6) uniform vec4 eye_in_room;   // metres inside of the west, east, south and north side
#endif

// At silhouettes a pixel's middle may lie outside the triangle that one of its samples is in: centroid.
out Shading {
  centroid vec3 sunlight;  // at the ground, what is left of it at the eye, times kSunRange
  centroid vec3 skylight;
  centroid vec3 haze;
#ifdef SHADE_FINE
  vec2 texel;
#endif
#ifdef SHADE_COARSE
  vec2 coarse_texel;
#endif
#if defined(SHADE_FINE) && defined(SHADE_COARSE)
  float share;  // of the coarser level
#endif
#ifdef GLINT
  centroid float glint;
#endif
#ifdef EFFECTS
  centroid vec3 relative;  // metres from the eye
  centroid float height;
  centroid vec3 left;  // share of the light that starts here and reaches the eye
#endif
#ifdef SEA
  centroid float depth;  // metres of water over the floor
#endif
#ifdef ROOM
  vec4 in_room;  // metres inside of its sides
#endif
} shading;
flat out vec3 layers;  // fine, coarse, level

invariant gl_Position;

#ifdef RIM
bool on_rim(ivec2 ab) {
  return ((rim & 1) != 0 && ab.x + ab.y == window.w) || ((rim & 2) != 0 && ab.x == 0) || ((rim & 4) != 0 && ab.y == 0) ||
         ((rim & 8) != 0 && ab == ivec2(0)) || ((rim & 16) != 0 && ab.x == window.w) || ((rim & 32) != 0 && ab.y == window.w);
}
#endif

#ifdef KNOTS_A_PATCH
#include "lib/interpolated_vertices.glsl"
#else
#include "lib/stored_vertices.glsl"
#endif

#ifdef SEA
#include "effects/sea_vertex.glsl"
#endif

void main() {
  int slot_index = instance.w;
  Slot slot = slots[slot_index];
  ivec2 ab = ivec2(local);
  ivec2 node = instance.xy + instance.z * ab;
  vec4 fine = fine_vertex(ab, slot);
  precise vec3 position = fine.xyz;
  float height = fine.w;

#ifdef MORPH
  ivec2 p = node * 1024;
  int distance = min(min(hex_length(p - slot.images_a.xy), hex_length(p - slot.images_a.zw)),
                     min(hex_length(p - slot.images_b.xy), hex_length(p - slot.images_b.zw)));
  float alpha = max(morph_factor(distance, window.y, window.z), slot.offset.w);
  vec4 target = coarse_vertex(ab, slot);
  position = vec3(exact_mix(position.x, target.x, alpha), exact_mix(position.y, target.y, alpha),
                  exact_mix(position.z, target.z, alpha));
  height = mix(height, target.w, alpha);
  Slot coarse = slots[slot.torus.w];
#if defined(SHADE_FINE) && defined(SHADE_COARSE)
  shading.share = shading_share(alpha);
#endif
#ifdef SHADE_COARSE
  shading.coarse_texel = vec2(node + slot.coarse.xy) * (0.5 * coarse.shading.zw) + coarse.shading.xy;
#endif
#endif
  position += slot.offset.xyz;

#ifdef RIM
  if (on_rim(ab)) {
    vec4 rim_vertex = vertex_on_rim(ab, slot, coarse);
    position = rim_vertex.xyz + coarse.offset.xyz;
    height = rim_vertex.w;
  }
#endif
#ifdef SEA
  shading.depth = -height;
  position = sea_over(position, height);
  height = 0.0;
#endif
  precise vec4 clip = view.clip_from_relative * vec4(position, 1.0);
  gl_Position = clip;

#ifdef SHADE_FINE
  shading.texel = vec2(node) * slot.shading.zw + slot.shading.xy;
#endif
#ifdef MORPH
  layers = vec3(slot.coarse.w, coarse.coarse.w, slot.coarse.z);
#else
  layers = vec3(slot.coarse.w, slot.coarse.w, slot.coarse.z);
#endif

#ifdef ROOM
  vec3 along = position * room_axes;
  shading.in_room = eye_in_room + vec4(along.x, -along.x, along.y, -along.y);
#endif
  AirLight light = air_light(position, height);
#ifdef GLINT
  shading.glint = sun_glint(light);
#endif
  shading.sunlight = light.sunlight * kSunRange;
  shading.skylight = light.skylight;
  shading.haze = light.haze;
#ifdef EFFECTS
  shading.relative = position;
  shading.height = height;
  shading.left = light.left;
#endif
}
