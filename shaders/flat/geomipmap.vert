#define OUT(type) out type
#include "lib/air_light.glsl"
#include "lib/lit_ground.glsl"
#include "lib/glint.glsl"
#include "lib/view.glsl"
#include "flat/geomorph.glsl"

#ifdef COLLAR
layout(location = 0) in vec2 post;       // from the eye's
layout(location = 1) in float stored_z;  // metres, in the tangent frame
layout(location = 2) in float lifted;    // 1: on the region's border
const ivec4 instance = ivec4(0);
#else
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
const float lifted = 1.0;
#endif

layout(location = 0) uniform mat3 axes;       // east, north, up of the frame in the world
layout(location = 1) uniform vec4 grid;       // metres between posts; the eye from its post, metres; curvature 1 / (2 R)
layout(location = 2) uniform vec4 eye;        // z, rounded and the rest; its post's place in the plane, metres
layout(location = 3) uniform vec4 texels;     // texture coordinate of the eye's post, and of a post
#ifdef LIFT
layout(location = 9) uniform ivec4 rim;       // the eye's post, the last column and row
layout(location = 11) uniform float band;     // posts from the border to where nothing is lifted
layout(binding = 1) uniform sampler2D lifts;  // metres, by post; rows: west, east, south, north
#include "flat/lift.glsl"

float lift_at(ivec2 at) {
  bool east = 2 * at.x > rim.z, north = 2 * at.y > rim.w;
  float share_x = lift_share(float(east ? rim.z - at.x : at.x), band);
  float share_y = lift_share(float(north ? rim.w - at.y : at.y), band);
  int beside = east ? 1 : 0;
  return lift_of(texelFetch(lifts, ivec2(at.y, beside), 0).r, texelFetch(lifts, ivec2(at.x, north ? 3 : 2), 0).r,
                 texelFetch(lifts, ivec2(north ? rim.w : 0, beside), 0).r, share_x, share_y);
}
#endif

out Shading {
  centroid vec3 sunlight;  // at the ground, what is left of it at the eye, times kSunRange
  centroid vec3 skylight;
  centroid vec3 haze;
  vec2 texel;
  vec2 plane;  // metres in the frame's plane
#ifdef GLINT
  centroid float glint;
#endif
#ifdef EFFECTS
  centroid vec3 relative;  // metres from the eye
  centroid float height;
  centroid vec3 left;  // share of the light that starts here and reaches the eye
#endif
} shading;
flat out vec2 level_and_number;

invariant gl_Position;

void main() {
  precise float z = stored_z;
#ifdef MORPH
  z = geomorph(stored_z, self_move, side_moves, both_moves, self_share, side_shares);
#endif
  // Whole numbers as long as they can be: two patches get the same for a post they share.
#ifdef COLLAR
  vec2 posts = post;
#else
  vec2 posts = vec2(instance.xy + ivec2(post));
#endif
#ifdef LIFT
  if (lifted > 0.0) z = z + lift_at(ivec2(posts) + rim.xy);
#endif
  precise vec3 local = vec3(posts * grid.x - grid.yz, (z - eye.x) - eye.y);
  precise vec3 position = axes * local;
  precise vec4 clip = view.clip_from_relative * vec4(position, 1.0);
  gl_Position = clip;

  shading.plane = posts * grid.x + eye.zw;
  float height = z + dot(shading.plane, shading.plane) * grid.w;
  AirLight light = air_light(position, height);
#ifdef GLINT
  shading.glint = sun_glint(light);
#endif
  shading.sunlight = light.sunlight * kSunRange;
  shading.skylight = light.skylight;
  shading.haze = light.haze;
  shading.texel = posts * texels.zw + texels.xy;
#ifdef EFFECTS
  shading.relative = position;
  shading.height = height;
  shading.left = light.left;
#endif
  level_and_number = vec2(instance.zw);
}
