// A small map of the sky as seen from the eye: across by the azimuth from the sun, up by the height above the horizon. Filled once
// a frame, looked up once a pixel. Both mappings with their inverse.

// Cosines from the vertical of what bounds the sky: the horizon, and the zenith or, from space, the top of the air.
vec2 sky_bounds(float eye_radius, float ground, float top) {
  float sin_horizon = min(ground / eye_radius, 1.0f);
  float horizon = -sqrt(max(1.0f - sin_horizon * sin_horizon, 0.0f));
  float sin_top = top / eye_radius;
  return vec2(horizon, eye_radius > top ? -sqrt(max(1.0f - sin_top * sin_top, 0.0f)) : 1.0f);
}

float sky_row(float cos_zenith, vec2 bounds) {
  return sqrt(clamp((cos_zenith - bounds.x) / (bounds.y - bounds.x), 0.0f, 1.0f));
}

float cos_zenith_of_row(float row, vec2 bounds) { return bounds.x + (bounds.y - bounds.x) * row * row; }

float sky_column(float cos_azimuth) { return 0.5f - 0.5f * cos_azimuth; }

float cos_azimuth_of_column(float column) { return 1.0f - 2.0f * column; }
