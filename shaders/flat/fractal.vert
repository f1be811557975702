// A post of a block of fractal ground (flat/fractal/drawer.h), lit and coloured here.
#include "lib/tone.glsl"
#include "flat/fractal_morph.glsl"

layout(location = 0) in vec3 ground;  // height, metres; its slopes eastward and northward
layout(location = 1) in ivec2 block;  // posts from the square's corner to the block's
layout(location = 2) in vec3 one;     // the same of the two posts that it goes between
layout(location = 3) in vec3 other;   // on the way to the next coarser level

uniform mat4 clip_from_relative;
uniform ivec2 eye_post;   // posts from the square's corner to the one south-west of the eye
uniform vec2 eye_within;  // and the eye from there, posts, 0 to 1
uniform float eye_height;
uniform float spacing;
uniform vec3 to_sun;
uniform vec3 sky;
uniform float per_sight;  // 1 / distance at which fog leaves 1/e
uniform vec2 base_and_relief;
uniform vec4 bands;       // posts from the eye between which levels 0 and 1 go over to the next: begin, end, begin, end

out vec3 shown;

invariant gl_Position;

const vec3 kMeadow = vec3(0.088, 0.112, 0.046);
const vec3 kHeath = vec3(0.150, 0.132, 0.082);
const vec3 kRock = vec3(0.200, 0.185, 0.170);
const vec3 kSnow = vec3(0.780, 0.800, 0.840);

// Grass low down, rock on the heights and wherever it is steep, snow where it is high and lies.
vec3 ground_color(float height, float steepness) {
  float above = (height - base_and_relief.x) / max(base_and_relief.y, 1e-3);
  vec3 color = mix(kMeadow, kHeath, smoothstep(-0.6, 0.4, above));
  color = mix(color, kRock, max(smoothstep(0.5, 1.0, above), smoothstep(0.55, 0.85, steepness)));
  return mix(color, kSnow, smoothstep(0.75, 1.15, above) * (1.0 - smoothstep(0.75, 1.1, steepness)));
}

vec3 lit_ground(vec3 ground) {
  vec3 normal = normalize(vec3(-ground.yz, 1.0));
  vec3 light = vec3(1.9, 1.75, 1.55) * max(dot(normal, to_sun), 0.0) + vec3(0.14, 0.20, 0.28) * (0.5 + 0.5 * normal.z);
  return tone_mapped(ground_color(ground.x, length(ground.yz)) * light);
}

void main() {
  int post = gl_VertexID % (POSTS_PER_SIDE * POSTS_PER_SIDE);
  ivec2 posts = block + ivec2(post % POSTS_PER_SIDE, post / POSTS_PER_SIDE) - eye_post;
  // The next coarser level lacks posts of odd columns or rows; the one after it those of which a half is odd.
  int either = (post % POSTS_PER_SIDE) | (post / POSTS_PER_SIDE);
  float away = length(vec2(posts) - eye_within);
  float share = (either & 1) != 0 ? share_of_band(away, bands.x, bands.y) : share_of_band(away, bands.z, bands.w);
  precise float height = ground.x + share * (0.5 * (one.x + other.x) - ground.x);
  precise vec3 position = vec3((vec2(posts) - eye_within) * spacing, height - eye_height);
  precise vec4 clip = clip_from_relative * vec4(position, 1.0);
  gl_Position = clip;
  // Colours, too, end as the coarser triangles have them.
  vec3 lit = mix(lit_ground(ground), 0.5 * (lit_ground(one) + lit_ground(other)), share);
  shown = mix(sky, lit, exp(-length(position) * per_sight));
}
