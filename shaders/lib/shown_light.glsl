#include "lib/tone.glsl"
#include "lib/active_effects.glsl"

// What a pass of the ground or the sky writes: the screen's colour, or light where a later pass shows it (shaders/tone.frag).
vec3 shown_light(vec3 light) {
#ifdef KEEP_LIGHT
  if ((active_effects & kKeepLight) != 0) return light;
#endif
  return tone_mapped(light);
}
