#include "lib/tone.glsl"

// Light of which the screen shows a colour: the inverse of tone_mapped. White is as bright as a sheet in the sun, not more.
vec3 light_shown_as(vec3 color) {
  vec3 y = clamp(color, vec3(0.0f), vec3(0.97f));
  vec3 a = vec3(5.94631142f) - 5.96147409f * y;
  vec3 b = vec3(0.104074837f) - 0.529102296f * y;
  vec3 r = (b + sqrt(b * b + 4.0f * a * y)) / (2.0f * a);
  return r * r;
}

// Light with a share of another colour over it, as a picture of it would be painted over: colours are mixed as the screen shows them.
vec3 marked_light(vec3 light, vec3 color, float share) {
  return share > 0.0f ? light_shown_as(mix(clamp(tone_mapped(light), vec3(0.0f), vec3(1.0f)), color, share)) : light;
}
