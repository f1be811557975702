// The sky's map in place of lib/sky_map.glsl, with what is narrow in it: the sun's aureole. Across by the sine of half the azimuth
// from the sun, which is even beside the sun; up by the root of the angle above the horizon, near enough. Plain GLSL of plain
// arguments: compiled as C++ too.
vec2 sky_bounds(float eye_radius, float ground, float top) {
  float sin_horizon = min(ground / eye_radius, 1.0f);
  float horizon = -sqrt(max(1.0f - sin_horizon * sin_horizon, 0.0f));
  float sin_top = top / eye_radius;
  return vec2(horizon, eye_radius > top ? -sqrt(max(1.0f - sin_top * sin_top, 0.0f)) : 1.0f);
}

float sky_row(float cos_zenith, vec2 bounds) {
  float share = clamp((bounds.y - cos_zenith) / (bounds.y - bounds.x), 0.0f, 1.0f);
  return sqrt(1.0f - (bounds.y < 1.0f ? share : sqrt(share)));
}

float cos_zenith_of_row(float row, vec2 bounds) {
  float share = 1.0f - row * row;
  return bounds.y - (bounds.y - bounds.x) * (bounds.y < 1.0f ? share : share * share);
}

float sky_column(float cos_azimuth) { return sqrt(max(0.5f - 0.5f * cos_azimuth, 0.0f)); }

float cos_azimuth_of_column(float column) { return 1.0f - 2.0f * column * column; }
