// Scene light to the screen: a filmic curve (Narkowicz 2015, fit of ACES) and the sRGB power.
vec3 tone_mapped(vec3 light) {
  vec3 x = light;
  vec3 c = clamp((x * (2.51f * x + vec3(0.03f))) / (x * (2.43f * x + vec3(0.59f)) + vec3(0.14f)), 0.0f, 1.0f);
  return pow(c, vec3(1.0f / 2.2f));
}
