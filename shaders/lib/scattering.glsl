// Light scattered any number of times in air of three kinds: molecules, droplets and dust, ozone. Kilometres from the planet's
// centre, sunlight of 1 above the air.
//
// The tables are those of Bruneton and Neyret 2008, "Precomputed Atmospheric Scattering", with the constants and mappings of Bruneton
// 2017 (its reference implementation), but for one: where they keep the light scattered so far for every direction, here are its
// moments, for Rayleigh's phase function asks of the light around a place its sum and its second moments and no more. Of droplets
// and dust, which scatter most of the light nearly straight on, a share is taken to go straight on, the rest to be scattered by the
// most forward function of such moments that is nowhere negative (Joseph, Wiscombe and Weinman 1976, "The Delta-Eddington
// Approximation"); light of the sun itself is scattered by their own phase function. So one table of height and sun serves, as in Hillaire 2020, "A Scalable and Production
// Ready Sky and Atmosphere Rendering Technique", yet no order of scattering is taken to be the same in all directions.
//
// Before this file come `air`, of the members of AirModel, and the tables:
//   vec3 transmittance_texel(vec2 place)       share of light left from a place to the top of the air
//   vec4 moments_texel(vec2 place, int layer)  light scattered so far; place: both 0 to 1, layer: kSum ...

const int kSum = 0;         // rgb: light from all directions; w of the first three: kUpward along the sun's azimuth, in place of z
const int kZenith = 1;      // rgb: times the square of the cosine to the zenith
const int kAzimuth = 2;     // rgb: times the square of the cosine to the sun's azimuth, level
const int kMixed = 3;       // rgb: times the product of both
const int kUpward = 4;      // rgb: times the cosine to the zenith
const int kIrradiance = 5;  // rgb: on level ground

// Of molecules, droplets and dust, ozone; 1 where each is densest.
vec3 densities(float h) {
  return vec3(exp(-h * air.rayleigh.w), exp(-h * air.mie.z), max(1.0f - abs(h - air.bounds.z) * air.ozone.w, 0.0f));
}

vec3 left_of_light(vec3 columns) {
  return exp(-(vec3(air.rayleigh) * columns.x + vec3(air.mie.y * columns.y) + vec3(air.ozone) * columns.z));
}

// The same along a ray, on which what dust scatters straight on stays.
vec3 left_of_ray(vec3 columns) {
  return exp(-(vec3(air.rayleigh) * columns.x + vec3(air.mie_moments.z * columns.y) + vec3(air.ozone) * columns.z));
}

float rayleigh_phase(float cos_angle) { return 0.0596831f * (1.0f + cos_angle * cos_angle); }

float mie_phase(float cos_angle) {
  float g2 = air.mie.w * air.mie.w;
  float base = 1.0f + g2 - 2.0f * air.mie.w * cos_angle;
  return 0.1193662f * (1.0f - g2) * (1.0f + cos_angle * cos_angle) / ((2.0f + g2) * base * sqrt(base));
}

// Place in the table of transmittance of a height and the cosine of a zenith angle, not below the horizon.
vec2 transmittance_place(float h, float cos_zenith) {
  float ground = air.bounds.x;
  float top = air.bounds.y;
  float across = sqrt(top * (2.0f * ground + top));  // from the ground's horizon to the top of the air
  float level = sqrt(max(h, 0.0f) * (2.0f * ground + h));
  float r = ground + h;
  float shortest = top - h;
  float away = max(sqrt(max(r * r * cos_zenith * cos_zenith + shortest * (2.0f * ground + top + h), 0.0f)) - r * cos_zenith, 0.0f);
  return vec2(clamp((away - shortest) / max(level + across - shortest, 1e-6f), 0.0f, 1.0f), level / across);
}

float horizon_cosine(float h) {
  float q = air.bounds.x / (air.bounds.x + max(h, 0.0f));
  return -sqrt(max(1.0f - q * q, 0.0f));
}

// Share of sunlight that reaches a height; none below the horizon.
vec3 sunlight_at(float h, float cos_sun) {
  float below = min(max(h, 0.0f), air.bounds.y);
  float horizon = horizon_cosine(below);
  vec3 light = transmittance_texel(transmittance_place(below, max(cos_sun, horizon)));
  return cos_sun >= horizon ? light : vec3(0.0f);
}

// Place in the table of moments: suns crowd about the horizon.
vec2 moments_place(float h, float cos_sun) {
  float width = 1.7f * abs(air.bounds.w);
  float x = clamp(cos_sun - air.bounds.w, 0.0f, 1.0f - air.bounds.w);
  return vec2(x / (x + width) * (1.0f - air.bounds.w + width) / (1.0f - air.bounds.w), sqrt(clamp(h / air.bounds.y, 0.0f, 1.0f)));
}

// Light of the whole sky on level ground.
vec3 skylight_at(float h, float cos_sun) { return vec3(moments_texel(moments_place(h, cos_sun), kIrradiance)); }

// Of the light scattered before, what a km of air sends along a ray where molecules and dust are densest.
struct Again {
  vec3 by_molecules;
  vec3 by_dust;
};

//   cos_zenith, cos_sun, cos_angle  of the ray, of the sun, and of the ray to the sun
Again scattered_again(float h, float cos_zenith, float cos_sun, float cos_angle) {
  vec2 place = moments_place(h, cos_sun);
  vec4 sum = moments_texel(place, kSum);
  vec4 zenith = moments_texel(place, kZenith);
  vec4 azimuth = moments_texel(place, kAzimuth);
  vec3 mixed = vec3(moments_texel(place, kMixed));
  vec3 upward = vec3(moments_texel(place, kUpward));
  vec3 onward = vec3(sum.w, zenith.w, azimuth.w);
  float a = cos_zenith;
  float b = clamp((cos_angle - a * cos_sun) * inversesqrt(max(1.0f - cos_sun * cos_sun, 1e-6f)), -1.0f, 1.0f);
  vec3 all = vec3(sum);
  vec3 zz = vec3(zenith);
  vec3 xx = vec3(azimuth);
  vec3 second = zz * (a * a) + xx * (b * b) + (all - zz - xx) * max(1.0f - a * a - b * b, 0.0f) + mixed * (2.0f * a * b);
  vec3 first = upward * a + onward * b;
  Again again;
  again.by_molecules = vec3(air.rayleigh) * ((all + second) * 0.0596831f);
  again.by_dust = (all * 0.0795775f + first * air.mie_moments.x + (second * 1.5f - all * 0.5f) * air.mie_moments.y) * air.mie_moments.w;
  return again;
}

vec3 scattered_once(vec3 density, float phase_rayleigh, float phase_mie) {
  return vec3(air.rayleigh) * (density.x * phase_rayleigh) + vec3(air.mie.x * density.y * phase_mie);
}

// Columns between two places `length` apart, of the densities there: those of molecules and dust fall exponentially.
vec3 columns_between(vec3 density, float h, vec3 next_density, float next_h, float length) {
  vec3 mean = 0.5f * (density + next_density);
  float x = abs(next_h - h) * air.rayleigh.w;
  float y = abs(next_h - h) * air.mie.z;
  if (x > 0.02f) mean.x = abs(next_density.x - density.x) / x;
  if (y > 0.02f) mean.y = abs(next_density.y - density.y) / y;
  return mean * length;
}

// Gauss and Legendre's four points in a panel (Abramowitz and Stegun 1964, table 25.4), as shares of it.
float gauss_place(int k) { return k == 0 ? 0.06943184420f : k == 1 ? 0.33000947821f : k == 2 ? 0.66999052179f : 0.93056815580f; }
float gauss_weight(int k) { return k == 0 || k == 3 ? 0.17392742257f : 0.32607257743f; }

// Distance along a ray of x in [0, 1] and how fast it grows there. Samples lie evenly by the root of their height above the ray's
// lowest point, at distance `lowest` from `from` to `to`, on both sides of it: a ray that ends soon after it, as those to the limb do,
// has but a few of them there. `rise` is the radius there times the cosine of the zenith angle.
vec2 spread_distance(float x, float from, float lowest, float to, float rise) {
  float up = abs(rise);
  float down_to = lowest - from;
  float up_to = to - lowest;
  float before = down_to > 1e-3f ? sqrt(down_to * (2.0f * up + down_to)) : 0.0f;
  float after = up_to > 1e-3f ? sqrt(up_to * (2.0f * up + up_to)) : 0.0f;
  float side = (before + after) * x - before;
  float root = max(sqrt(up * up + side * side), 1e-6f);
  float away = side * side / (up + root);
  return vec2(side < 0.0f ? lowest - away : lowest + away, (before + after) * abs(side) / root);
}

// Light of the air along a ray. `panels`, even, of four samples each; what is scattered again is looked up for every sample or, where
// `sparing`, for every other, as it changes slowly.
vec3 air_radiance(vec3 eye, vec3 direction, float from, float to, vec3 sun, int panels, bool sparing, OUT(vec3) transmitted) {
  float cos_angle = dot(direction, sun);
  float phase_r = rayleigh_phase(cos_angle);
  float phase_m = mie_phase(cos_angle);
  float lowest = clamp(-dot(eye, direction), from, to);
  float rise = lowest + dot(eye, direction);
  Again again;
  vec3 light = vec3(0.0f);
  vec3 columns = vec3(0.0f);
  vec3 start = eye + direction * from;
  float before = from;
  float h_before = max(sqrt(dot(start, start)) - air.bounds.x, 0.0f);
  vec3 density_before = densities(h_before);
  for (int panel = 0; panel < panels; ++panel) {
    for (int k = 0; k < 4; ++k) {
      vec2 at = spread_distance((float(panel) + gauss_place(k)) / float(panels), from, lowest, to, rise);
      vec3 p = eye + direction * at.x;
      float r = sqrt(dot(p, p));
      float h = max(r - air.bounds.x, 0.0f);
      float cos_sun = dot(p, sun) / r;
      vec3 density = densities(h);
      columns += columns_between(density_before, h_before, density, h, at.x - before);
      if (!sparing || k == 0 || k == 2) again = scattered_again(h, dot(p, direction) / r, cos_sun, cos_angle);
      vec3 sent = sunlight_at(h, cos_sun) * scattered_once(density, phase_r, phase_m) + again.by_molecules * density.x +
                  again.by_dust * density.y;
      light += left_of_ray(columns) * sent * (at.y * gauss_weight(k) / float(panels));
      before = at.x;
      h_before = h;
      density_before = density;
    }
  }
  vec3 stop = eye + direction * to;
  float h_stop = max(sqrt(dot(stop, stop)) - air.bounds.x, 0.0f);
  columns += columns_between(density_before, h_before, densities(h_stop), h_stop, to - before);
  transmitted = left_of_ray(columns);
  return light;
}
