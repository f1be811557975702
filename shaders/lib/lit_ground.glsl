// Ground lit before it is drawn: one texel holds what albedo and slope would take two look-ups for.
//
// With n the ground's normal, u that of the ellipsoid and s the direction toward the sun, level ground of albedo A under
// sunlight S and skylight K shines with A (S max(n.s, 0) + K sky_share(n.u)). A texel is
//   rgb = sqrt(A sky_share),  a = sqrt(max(n.s, 0) / (sky_share kSunRange)),
// of which look-ups between nodes are taken as they are. Written by globe/clipmap/lighting.cpp.

// Share of the sky's light that ground tilted from the vertical by acos(up) receives.
float sky_share(float up) { return 0.55f + 0.45f * up; }

// Largest max(n.s, 0) / sky_share: 1 / sky_share(0).
const float kSunRange = 1.8181819f;

vec4 lit_ground(vec3 albedo, float up, float facing) {
  float share = sky_share(up);
  return vec4(sqrt(albedo * share), sqrt(max(facing, 0.0f) / (share * kSunRange)));
}

// Light that leaves lit ground. `sunlight` comes multiplied by kSunRange.
vec3 ground_light(vec4 lit, vec3 sunlight, vec3 skylight) {
  vec3 root = vec3(lit);
  return root * root * (sunlight * (lit.w * lit.w) + skylight);
}
