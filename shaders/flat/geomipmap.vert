#define OUT(type) out type
#include "lib/air_light.glsl"
#include "lib/lit_ground.glsl"
#include "lib/view.glsl"
#include "flat/geomorph.glsl"

layout(location = 0) in uvec2 post;      // from the patch's south-west one
layout(location = 1) in float stored_z;  // metres, in the tangent frame
#ifdef MORPH
layout(location = 2) in float self_move;
layout(location = 3) in vec4 side_moves;  // west, east, south, north
layout(location = 4) in vec4 both_moves;
#endif
// Of the patch: its south-west post from the eye's, level, number.
layout(location = 5) in ivec4 instance;
layout(location = 6) in vec4 side_shares;
layout(location = 7) in float self_share;

layout(location = 0) uniform mat3 axes;       // east, north, up of the frame in the world
layout(location = 1) uniform vec4 grid;       // metres between posts; the eye from its post, metres; curvature 1 / (2 R)
layout(location = 2) uniform vec4 eye;        // z, rounded and the rest; its post's place in the plane, metres
layout(location = 3) uniform vec4 texels;     // texture coordinate of the eye's post, and of a post

out Shading {
  centroid vec3 sunlight;  // at the ground, what is left of it at the eye, times kSunRange
  centroid vec3 skylight;
  centroid vec3 haze;
  vec2 texel;
  vec2 plane;  // metres in the frame's plane
} shading;
flat out vec2 level_and_number;

invariant gl_Position;

void main() {
  precise float z = stored_z;
#ifdef MORPH
  z = geomorph(stored_z, self_move, side_moves, both_moves, self_share, side_shares);
#endif
  // Whole numbers as long as they can be: two patches get the same for a post they share.
  vec2 posts = vec2(instance.xy + ivec2(post));
  precise vec3 local = vec3(posts * grid.x - grid.yz, (z - eye.x) - eye.y);
  precise vec3 position = axes * local;
  precise vec4 clip = view.clip_from_relative * vec4(position, 1.0);
  gl_Position = clip;

  shading.plane = posts * grid.x + eye.zw;
  AirLight light = air_light(position, z + dot(shading.plane, shading.plane) * grid.w);
  shading.sunlight = light.sunlight * kSunRange;
  shading.skylight = light.skylight;
  shading.haze = light.haze;
  shading.texel = posts * texels.zw + texels.xy;
  level_and_number = vec2(instance.zw);
}
