// How much of a medium a ray passes whose density falls exponentially with height, over a round planet. Plain GLSL of plain
// arguments: the tests compile this file as C++ too.

// exp(x^2) erfc(x) for x >= 0, within 0.12 %: between the bounds of Abramowitz and Stegun 7.1.13, which differ by the number under
// the root; that number is fitted.
float scaled_erfc(float x) {
  float under = mix(1.2732395f, 2.0f, (1.64356f + x) * x / (2.07471f + (1.57081f + x) * x));
  return 1.1283792f / (x + sqrt(x * x + under));
}

// Integral of density along `away` metres from the lower end of a ray, metres of the density at height 0. `low` is that end's height
// over the layer's base, `rise` the sine of the ray's elevation there, `scale` the height in which density falls to 1/e, `radius` the
// planet's. Heights along the ray to second order: h(s) = low + rise s + (1 - rise^2) s^2 / (2 radius).
float layer_depth(float low, float rise, float away, float scale, float radius) {
  float bend = max((1.0f - rise * rise) / (2.0f * radius), 1e-12f);
  float fall = (rise + bend * away) * away / scale;
  if (abs(fall) < 1.0f) {
    // Where density hardly changes the difference below would lose its digits: three points of Gauss and Legendre.
    float near = 0.1127017f * away;
    float far = 0.8872983f * away;
    float middle = 0.5f * away;
    return away * exp(-low / scale) / 18.0f *
           (5.0f * exp(-(rise + bend * near) * near / scale) + 8.0f * exp(-(rise + bend * middle) * middle / scale) +
            5.0f * exp(-(rise + bend * far) * far / scale));
  }
  float root = sqrt(bend * scale);
  float first = rise / (2.0f * root);
  float last = first + away * sqrt(bend / scale);
  float across = 0.8862269f * scale / root;  // sqrt(pi scale / bend) / 2
  if (first >= 0.0f) {
    float dimmer = exp(max(-fall, -80.0f));
    return across * exp(-low / scale) * max(scaled_erfc(first) - dimmer * scaled_erfc(last), 0.0f);
  }
  float lowest = low - rise * rise / (4.0f * bend);
  float both = 2.0f - exp(-first * first) * scaled_erfc(-first) - exp(-last * last) * scaled_erfc(max(last, 0.0f));
  return across * exp(-lowest / scale) * max(both, 0.0f);
}
