// A quad at infinity around each star, as wide as its image (globe/effects/stars.cpp).
#define OUT(type) out type
#include "lib/atmosphere.glsl"
#include "lib/view.glsl"

layout(location = 0) in vec4 star;   // unit direction in the celestial frame; w: light in a pixel's area
layout(location = 1) in vec3 color;

layout(location = 0) uniform mat3 from_celestial;  // to world axes
layout(location = 1) uniform vec4 image;           // 2 / pixels across and up, radius in pixels, brightness

out vec2 from_middle;  // in radii
flat out vec3 light;

void main() {
  vec3 direction = from_celestial * star.xyz;
  vec4 clip = view.clip_from_relative * vec4(direction, 0.0);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  from_middle = corner;
  clip.xy += corner * image.xy * image.z * clip.w;
  gl_Position = vec4(clip.xy, 0.0, clip.w);
  light = color * star.w * image.w;
  if (view.rounding.z > 0.0) {
    vec3 toward = normalize(direction * view.rounding.xxy);
    float radius = length(view.eye_km.xyz);
    light *= sun_transmittance(max(radius - view.eye_km.w, 0.0), dot(view.eye_km.xyz, toward) / radius, view.eye_km.w);
  }
}
