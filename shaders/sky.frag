#define OUT(type) out type
#include "lib/atmosphere.glsl"
#include "lib/tone.glsl"
#include "lib/view.glsl"

in vec3 ray;
out vec4 color;

const float kCosSunRadius = 0.9999892;  // 0.266 degrees

void main() {
  vec3 direction = normalize(ray);
  vec3 light = vec3(0.0);
  vec3 through = vec3(1.0);
  if (view.axes_km.z > 0.0) {
    vec3 eye = view.eye_km.xyz;
    float ground = view.eye_km.w;
    float top = ground + kAirTop;
    float along = dot(eye, direction);
    // Height of the ray's nearest point from the distance itself: no cancellation at orbit.
    vec3 nearest = eye - direction * along;
    float gap = top * top - dot(nearest, nearest);
    if (gap > 0.0) {
      float half_chord = sqrt(gap);
      float from = max(-along - half_chord, 0.0);
      float to = -along + half_chord;
      if (to > 0.0) light = inscattered(eye, direction, from, to, view.sun.xyz, ground, SKY_STEPS, through) * view.sun.w;
    }
  }
  float beside = dot(direction, view.sun.xyz);
  light += through * view.sun.w * 60.0 * smoothstep(kCosSunRadius - 4e-6, kCosSunRadius + 4e-6, beside);
  color = vec4(tone_mapped(light * view.axes_km.w), 1.0);
}
