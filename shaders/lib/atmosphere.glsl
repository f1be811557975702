// Single scattering in an exponential atmosphere, in kilometres from the planet's centre.
//
// Rayleigh and Mie coefficients for the Earth's air at sea level: Bruneton and Neyret 2008, "Precomputed Atmospheric
// Scattering", section 4. Column above a point by Schüler's approximation of the Chapman function (GPU Pro 3, 2012, "An
// Approximation to the Chapman Grazing-Incidence Function"): within some 5 % of the integral, dearer than nothing.

const vec3 kRayleigh = vec3(5.802e-3f, 13.558e-3f, 33.1e-3f);  // scattering per km
const float kMieScattering = 3.0e-3f;
const float kMieExtinction = 3.4e-3f;
const float kRayleighHeight = 8.0f;  // scale heights, km
const float kMieHeight = 1.2f;
const float kMieAsymmetry = 0.76f;
const float kAirTop = 80.0f;
const float kSkyHeight = 12.0f;  // height over which the light of the sky falls to 1/e

// Column of air above a point in units of its density there times the scale height; x = radius / scale height.
float chapman_upward(float x, float cos_zenith) {
  float c = sqrt(1.5707963f * x);
  return c / ((c - 1.0f) * cos_zenith + 1.0f);
}

// Column from height h (km) toward the sun or the sky, km of sea-level air. Below the horizon the ray dips to its lowest point
// first; inside the ground the column grows without bound, which is night.
float air_column(float h, float cos_zenith, float ground, float scale_height) {
  float r = (ground + h) / scale_height;
  float density = exp(-h / scale_height);
  if (cos_zenith >= 0.0f) return scale_height * density * chapman_upward(r, cos_zenith);
  float sin_zenith = sqrt(max(1.0f - cos_zenith * cos_zenith, 0.0f));
  float lowest = (ground + h) * sin_zenith - ground;
  float through = 2.0f * exp(min(-lowest / scale_height, 30.0f)) * chapman_upward(max(r * sin_zenith, 1.0f), 0.0f);
  return scale_height * (through - density * chapman_upward(r, -cos_zenith));
}

vec3 extinction(float rayleigh_column, float mie_column) {
  return exp(-(kRayleigh * rayleigh_column + vec3(kMieExtinction * mie_column)));
}

// Share of sunlight that reaches height h when the sun stands at a zenith angle.
vec3 sun_transmittance(float h, float cos_sun, float ground) {
  return extinction(air_column(h, cos_sun, ground, kRayleighHeight), air_column(h, cos_sun, ground, kMieHeight));
}

// Light of the sky from above on level ground, for sunlight of 1: a fit by eye, blue by day, fading through twilight.
vec3 sky_irradiance(float h, float cos_sun) {
  float day = smoothstep(-0.16f, 0.35f, cos_sun);
  return vec3(0.11f, 0.145f, 0.20f) * day * exp(-max(h, 0.0f) / kSkyHeight);
}

float rayleigh_phase(float cos_angle) { return 0.0596831f * (1.0f + cos_angle * cos_angle); }

float mie_phase(float cos_angle) {
  float g2 = kMieAsymmetry * kMieAsymmetry;
  float base = 1.0f + g2 - 2.0f * kMieAsymmetry * cos_angle;
  return 0.1193662f * (1.0f - g2) * (1.0f + cos_angle * cos_angle) / ((2.0f + g2) * base * sqrt(base));
}

// Distance along a ray of sample x in [0, 1]: samples crowd where the ray is lowest, at distance `lowest` between `from` and `to`,
// for there the air is densest: the near end of a look upward, the far end of a look down, the middle of a look past the limb.
float sample_distance(float x, float from, float lowest, float to) {
  float begin = lowest > from + 1e-3f ? 0.0f : 0.5f;
  float end = to > lowest + 1e-3f ? 1.0f : 0.5f;
  float side = 2.0f * (begin + (end - begin) * x) - 1.0f;
  return side < 0.0f ? lowest - (lowest - from) * side * side : lowest + (to - lowest) * side * side;
}

// The same light between the eye and a place on the ground, cheap enough for every vertex: the sun's share is taken at both ends
// and carried linearly between them.
vec3 haze(vec3 eye, vec3 direction, float from, float to, vec3 sun, vec3 sun_at_from, vec3 sun_at_to, float cos_sun, float ground,
          int steps, OUT(vec3) transmitted) {
  float cos_angle = dot(direction, sun);
  float phase_m = mie_phase(cos_angle);
  vec3 again = sky_irradiance(0.0f, cos_sun) * 0.2f;
  float lowest = clamp(-dot(eye, direction), from, to);
  vec3 first = sun_at_from * rayleigh_phase(cos_angle);
  vec3 change = (sun_at_to - sun_at_from) * rayleigh_phase(cos_angle);
  float mie_share = phase_m / rayleigh_phase(cos_angle);
  vec3 light = vec3(0.0f);
  float column_r = 0.0f;
  float column_m = 0.0f;
  float previous = from;
  for (int k = 0; k < steps; ++k) {
    float next = sample_distance(float(k + 1) / float(steps), from, lowest, to);
    float length = next - previous;
    float middle = 0.5f * (previous + next);
    vec3 p = eye + direction * middle;
    float h = max(sqrt(dot(p, p)) - ground, 0.0f);
    float density_r = exp(-h / kRayleighHeight) * length;
    float density_m = exp(-h / kMieHeight) * length;
    vec3 here = extinction(column_r + 0.5f * density_r, column_m + 0.5f * density_m);
    vec3 lit = first + change * ((middle - from) / max(to - from, 1e-6f));
    float mie = kMieScattering * density_m;
    vec3 repeated = again * exp(-h / kSkyHeight);
    light += here * (lit * (kRayleigh * density_r + vec3(mie * mie_share)) + repeated * (kRayleigh * density_r + vec3(mie)));
    column_r += density_r;
    column_m += density_m;
    previous = next;
  }
  transmitted = extinction(column_r, column_m);
  return light;
}

// Sky light along a ray (km), for sunlight of 1: Rayleigh and repeated scattering in rgb, Mie scattering without its phase, in
// red, in alpha. `steps` is the knob: error falls with its square. Twice-scattered light is added as a share of the
// once-scattered without direction.
vec4 sky_light(vec3 eye, vec3 direction, float from, float to, vec3 sun, float ground, int steps) {
  float phase_r = rayleigh_phase(dot(direction, sun));
  float lowest = clamp(-dot(eye, direction), from, to);
  vec4 light = vec4(0.0f);
  float column_r = 0.0f;
  float column_m = 0.0f;
  float previous = from;
  for (int k = 0; k < steps; ++k) {
    float next = sample_distance(float(k + 1) / float(steps), from, lowest, to);
    float length = next - previous;
    vec3 p = eye + direction * (0.5f * (previous + next));
    float r = sqrt(dot(p, p));
    float h = max(r - ground, 0.0f);
    float density_r = exp(-h / kRayleighHeight) * length;
    float density_m = exp(-h / kMieHeight) * length;
    float cos_sun = dot(p, sun) / r;
    vec3 here = extinction(column_r + 0.5f * density_r, column_m + 0.5f * density_m);
    vec3 lit = here * sun_transmittance(h, cos_sun, ground);
    vec3 again = here * sky_irradiance(h, cos_sun) * 0.2f;
    vec3 rayleigh = kRayleigh * density_r;
    float mie = kMieScattering * density_m;
    light += vec4(lit * rayleigh * phase_r + again * (rayleigh + vec3(mie)), lit.x * mie);
    column_r += density_r;
    column_m += density_m;
    previous = next;
  }
  return light;
}

// Sky light in all its colours. Mie light from its red: it is dimmed on its way as the Rayleigh light is (Bruneton and Neyret 2008,
// section 4).
vec3 with_mie(vec4 light, float cos_angle) {
  float share = min(light.w / max(light.x, 1e-7f), 12.0f);  // where next to no light is left its colour says nothing
  return vec3(light) + vec3(light) * (kRayleigh.x / kRayleigh) * (share * mie_phase(cos_angle));
}
