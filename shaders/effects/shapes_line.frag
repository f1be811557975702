// Pixels of the drawn ground that lie on a line: by the depth that is there already.
#include "lib/marked_light.glsl"
#include "lib/view.glsl"

layout(binding = 0) uniform sampler2D depth;
layout(location = 0) uniform vec4 ink;    // colour as the screen shows it; w: opacity, below 0: what is left of the light is asked for
layout(location = 1) uniform vec4 sizes;  // as in the vertex shader

flat in vec4 across;
flat in vec4 along;
flat in vec2 size;

out vec4 color;

// How depth changes to the next pixel: on the side where the ground goes on. Depth is linear over a plane.
float slope(ivec2 pixel, ivec2 step, float here) {
  float before = here - texelFetch(depth, pixel - step, 0).r;
  float after = texelFetch(depth, pixel + step, 0).r - here;
  return abs(before) < abs(after) ? before : after;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float here = texelFetch(depth, pixel, 0).r;
  if (here <= 0.0) discard;
  float near = view.clip_from_relative[3].z;
  float away = near / here;
  vec2 ndc = gl_FragCoord.xy / sizes.zw * 2.0 - 1.0;
  vec3 ray = view.forward.xyz + view.right.xyz * ndc.x + view.up.xyz * ndc.y;
  vec3 at = ray * away;
  vec2 place = vec2(dot(along.xyz, at) - along.w, dot(across.xyz, at) - across.w);
  // What a step of a pixel is on the ground, along and across the line.
  ivec2 inside = clamp(pixel, ivec2(1), ivec2(sizes.zw) - 2);
  vec2 rises = vec2(slope(inside, ivec2(1, 0), texelFetch(depth, inside, 0).r), slope(inside, ivec2(0, 1), texelFetch(depth, inside, 0).r));
  vec2 grows = -rises * away / here;
  vec3 right = view.right.xyz * (2.0 / sizes.z) * away + ray * grows.x;
  vec3 up = view.up.xyz * (2.0 / sizes.w) * away + ray * grows.y;
  vec2 steps_along = vec2(dot(along.xyz, right), dot(along.xyz, up));
  vec2 steps_across = vec2(dot(across.xyz, right), dot(across.xyz, up));
  // And back: metres to pixels.
  float area = steps_along.x * steps_across.y - steps_along.y * steps_across.x;
  vec2 a_metre = vec2(steps_across.y, -steps_across.x) / area;   // along the line, in pixels
  vec2 aside = vec2(-steps_along.y, steps_along.x) / area;
  vec2 direction = normalize(a_metre);
  vec2 from_a = a_metre * place.x + aside * place.y;
  vec2 from_b = a_metre * (place.x - size.x) + aside * place.y;
  float away_px = abs(place.y) / length(steps_across);
  if (size.x == 0.0 || dot(from_a, direction) < 0.0) away_px = length(from_a);
  else if (dot(from_b, direction) > 0.0) away_px = length(from_b);
  float cover = clamp(size.y + 0.5 - away_px, 0.0, min(2.0 * size.y, 1.0));
  if (!(cover > 0.0)) discard;
  color = vec4(light_shown_as(ink.rgb), ink.a < 0.0 ? 1.0 + ink.a * cover : ink.a * cover);
}
