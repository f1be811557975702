// Scene light (at least 0) to the screen: a filmic curve (Narkowicz 2015, fit of ACES) and the sRGB encoding (IEC 61966-2-1), both
// in one rational function of the square root. Within 0.0035 of them, less than one step of eight bits, over all light. It passes
// 0 and 1 by less than that: pictures of normalised bytes clamp.
vec3 tone_mapped(vec3 light) {
  vec3 r = sqrt(light);
  return r * (5.94631142f * r - 0.104074837f) / (vec3(1.0f) + r * (5.96147409f * r - 0.529102296f));
}
