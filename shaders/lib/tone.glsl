// Scene light (at least 0) to the screen: a filmic curve (Narkowicz 2015, fit of ACES) and the power 1/2.2, both in one rational
// function of the square root. Within 0.0008 of them over all light; reaches 1 at a light of about 7.
vec3 tone_mapped(vec3 light) {
  vec3 r = sqrt(light);
  vec3 shown = r * (0.683383549f + r * (1.14651087f + 17.3904143f * r)) /
               (vec3(1.0f) + r * (1.89807366f + r * (1.13241868f + 17.1901173f * r)));
  return min(shown, vec3(1.0f));
}
