// The screen filled through a tone curve, for app/accuracy/shading_studies.cpp.
#include "lib/tone.glsl"

layout(location = 0) uniform vec2 size;  // pixels

out vec4 color;

// What lib/tone.glsl stands for: Narkowicz 2015 and IEC 61966-2-1.
vec3 exact_tone(vec3 light) {
  vec3 film = clamp(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
  return mix(12.92 * film, 1.055 * pow(film, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, film));
}

void main() {
  vec3 light = vec3(gl_FragCoord.xy / size, 0.5) * 4.0;
#ifdef EXACT
  color = vec4(exact_tone(light), 1.0);
#else
  color = vec4(tone_mapped(light), 1.0);
#endif
}
