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
const float kTwilight = 0.3f;    // cosine of the sun's zenith angle: lower, its share is sampled along rays

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

// Of a stretch of air, by the cosines of the sun's zenith angle at both ends: whether it is all in the planet's shadow, which is
// convex; and whether the sun's share changes so much along it that each sample needs its own.
bool is_night(float cos_sun_at_from, float cos_sun_at_to, float ground) {
  return max(cos_sun_at_from, cos_sun_at_to) < -0.01f - sqrt(2.0f * kAirTop / ground);
}

bool is_twilight(float cos_sun_at_from, float cos_sun_at_to, float ground) {
  return min(cos_sun_at_from, cos_sun_at_to) < kTwilight && !is_night(cos_sun_at_from, cos_sun_at_to, ground);
}

// The same light between the eye and a place on the ground, cheap enough for every vertex: the air that the sun's light has passed
// is taken to be the density at a sample times a factor, had at both ends and carried linearly between them. Not in twilight.
vec3 haze(vec3 eye, vec3 direction, float from, float to, vec3 sun, float cos_sun_at_from, float cos_sun_at_to, float ground,
          int steps, OUT(vec3) transmitted) {
  float cos_angle = dot(direction, sun);
  float phase_r = rayleigh_phase(cos_angle);
  float phase_m = mie_phase(cos_angle);
  vec3 again = sky_irradiance(0.0f, cos_sun_at_to) * 0.2f;
  float lowest = clamp(-dot(eye, direction), from, to);
  float day_at_from = max(cos_sun_at_from, 0.0f);
  float day_at_to = max(cos_sun_at_to, 0.0f);
  vec2 sunward = vec2(kRayleighHeight * chapman_upward(ground / kRayleighHeight, day_at_from),
                      kMieHeight * chapman_upward(ground / kMieHeight, day_at_from));
  vec2 change = vec2(kRayleighHeight * chapman_upward(ground / kRayleighHeight, day_at_to),
                     kMieHeight * chapman_upward(ground / kMieHeight, day_at_to)) -
                sunward;
  float per_km = 1.0f / max(to - from, 1e-6f);
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
    float at_r = exp(-h / kRayleighHeight);
    float at_m = exp(-h / kMieHeight);
    float density_r = at_r * length;
    float density_m = at_m * length;
    vec2 toward_sun = sunward + change * ((middle - from) * per_km);
    float passed_r = column_r + 0.5f * density_r;
    float passed_m = column_m + 0.5f * density_m;
    vec3 here = extinction(passed_r, passed_m);
    vec3 lit = extinction(passed_r + at_r * toward_sun.x, passed_m + at_m * toward_sun.y);
    vec3 rayleigh = kRayleigh * density_r;
    float mie = kMieScattering * density_m;
    vec3 repeated = again * exp(-h / kSkyHeight);
    light += lit * (rayleigh * phase_r + vec3(mie * phase_m)) + here * repeated * (rayleigh + vec3(mie));
    column_r += density_r;
    column_m += density_m;
    previous = next;
  }
  transmitted = extinction(column_r, column_m);
  return is_night(cos_sun_at_from, cos_sun_at_to, ground) ? vec3(0.0f) : light;
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

// Light of the air between the eye and a place: by haze(), in twilight by sky_light() with twice the samples.
vec3 light_before(vec3 eye, vec3 direction, float from, float to, vec3 sun, float cos_sun_at_to, float ground, int steps,
                  OUT(vec3) transmitted) {
  vec3 first = eye + direction * from;
  float cos_sun_at_from = dot(first, sun) / sqrt(dot(first, first));
  vec3 light = haze(eye, direction, from, to, sun, cos_sun_at_from, cos_sun_at_to, ground, steps, transmitted);
  int exact_steps = is_twilight(cos_sun_at_from, cos_sun_at_to, ground) ? 2 * steps : 0;  // a loop of no turns costs nothing
  vec4 exact = sky_light(eye, direction, from, to, sun, ground, exact_steps);
  return exact_steps > 0 ? with_mie(exact, dot(direction, sun)) : light;
}
