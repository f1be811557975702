#define OUT(type) out type
#include "lib/atmosphere.glsl"
#include "lib/ground_pixel.glsl"
#include "lib/lit_ground.glsl"
#include "lib/sky_map.glsl"
#include "effects.glsl"

layout(binding = 4) uniform sampler2D sky_map;

out vec4 color;

const float kPi = 3.14159265;

struct Waves {
  vec3 slope;      // of the surface, level
  float variance;  // of the slopes that a pixel does not show
  float crest;     // curvature of the long waves times their lengths, > 0 on crests
};

Waves waves_at(vec3 relative_m, float shoal) {
  vec3 offset = sea_offset(relative_m);
  float level_2 = level_part_2(offset);
  vec3 right = dFdx(offset);
  vec3 ahead = dFdy(offset);
  Waves waves = Waves(vec3(0.0), 0.0, 0.0);
  vec3 drift = vec3(0.0);
  int count = int(sea.level.x);
  for (int k = 0; k < count; ++k) {
    vec3 along = sea.along[k].xyz;
    float number = sea.along[k].w;
    float across = number * (abs(dot(right, along)) + abs(dot(ahead, along)));
    float share = pixel_share(across);
    float steepness = sea.form[k].x * number;
    if (across > 12.0) {  // nothing is left of the shorter ones either
      waves.variance += sea.form[k].w;
      break;
    }
    waves.variance += 0.5 * steepness * steepness * (1.0 - share * share);
    if (share > 0.0) {
      float phase = number * wave_way(offset + drift, level_2, along, sea.form[k].z, sea.level.y) + sea.form[k].y;
      float sine = share * sin(phase);
      waves.slope -= along * (steepness * sine);
      // Shorter waves ride on this one, whose water moves toward its crests: else they would all be straight lines.
      drift += along * (sea.form[k].x * sine);
      waves.crest += number < 4.0 ? share * steepness * cos(phase) : 0.0;
    }
  }
  // Ripples reach farther up the shore than waves do.
  float calm = max(shoal, 0.25);
  waves.slope *= calm;
  // The nearer, the more of what is shorter than the waves is seen as what it is, not as roughness.
  waves.variance = waves.variance * calm * calm + sea.color.w * mix(0.3, 1.0, smoothstep(0.0, 200.0, length(relative_m)));
  waves.crest *= shoal;
  return waves;
}

// Light of the sky in a direction above the horizon, for sunlight of 1. The map is that of the eye: it serves as long as that is in
// the lower air; from higher up the mean of the sky does.
vec3 sky_toward(vec3 direction, vec3 up) {
  if (view.rounding.z == 0.0) return vec3(0.0);
  vec3 sun = view.sun.xyz;
  float cos_zenith = dot(direction, up);
  vec3 mean = sky_irradiance(0.0, dot(sun, up)) / kPi * (0.8 + 1.4 * pow(1.0 - max(cos_zenith, 0.0), 4.0));
  float radius = length(view.eye_km.xyz);
  float high = smoothstep(3.0, 15.0, radius - view.eye_km.w);
  if (high == 1.0) return mean;
  vec2 bounds = sky_bounds(radius, view.eye_km.w, view.eye_km.w + kAirTop);
  vec3 level = direction - up * cos_zenith;
  vec3 toward_sun = sun - up * dot(sun, up);
  float cos_azimuth = dot(level, toward_sun) * inversesqrt(max(dot(level, level) * dot(toward_sun, toward_sun), 1e-12));
  vec2 place = vec2(sky_column(clamp(cos_azimuth, -1.0, 1.0)), sky_row(cos_zenith, bounds));
  vec2 size = vec2(textureSize(sky_map, 0));
  vec3 light = with_mie(texture(sky_map, (place * (size - 1.0) + 0.5) / size), dot(direction, sun));
  return mix(light, mean, high);
}

// Share of light that a surface of such slopes reflects: fit of Bruneton, Neyret and Holzschuch 2010, "Real-time Realistic Ocean
// Lighting using Seamless Transitions from Geometry to BRDF", section 5.2.
float mean_reflectance(float cosine, float variance) {
  float sigma = sqrt(0.5 * variance);
  return 0.02 + 0.98 * pow(1.0 - cosine, 5.0 * exp(-2.69 * sigma)) / (1.0 + 22.7 * pow(sigma, 1.5));
}

// Light of the sun mirrored to the eye, for sunlight (over pi) of 1: slopes are Gaussian (Cox and Munk 1954).
float glint(vec3 normal, vec3 toward_eye, vec3 up, float variance) {
  vec3 half_way = normalize(view.sun.xyz + toward_eye);
  float c = dot(half_way, normal);
  if (c <= 0.05) return 0.0;
  float c_2 = c * c;
  float slopes = exp((c_2 - 1.0) / (c_2 * variance)) / (kPi * variance * c_2 * c_2);
  float mirrored = 0.02 + 0.98 * pow(1.0 - max(dot(half_way, toward_eye), 0.0), 5.0);
  float seen = max(dot(normal, toward_eye), 0.0) + 0.5 * sqrt(variance);
  return kPi * mirrored * slopes / (4.0 * seen);
}

void main() {
  vec3 sunlight = shading.sunlight;  // times kSunRange
  vec3 skylight = shading.skylight;
  Place place = place_at(shading.relative, 0.0, shading.left);
  dim_by_effects(sunlight, skylight, place);
  vec3 up = place.up;
  vec3 toward_eye = -normalize(shading.relative);
  float depth = max(shading.depth, 0.0);
  float shoal = shoal_share(depth, sea.level.z);
  Waves waves = waves_at(shading.relative, shoal);
  vec3 normal = normalize(up - (waves.slope - up * dot(waves.slope, up)));
  vec3 sun_level = sunlight / kSunRange;
  float cos_sun = max(dot(up, view.sun.xyz), 0.0);
  vec3 air = shading.left * view.sun.w;

  vec3 light;
  if (sea.level.w == 0.0) {
    float facing = dot(normal, toward_eye);
    float least = 0.02;
    if (facing < least) normal = normalize(normal + toward_eye * (least - facing));
    float cosine = max(dot(normal, toward_eye), 0.0);
    float mirrored = mean_reflectance(cosine, waves.variance) * smoothstep(0.0, 0.25, depth);

    // Where slopes are not shown those that turn to the eye are seen, which mirror higher sky.
    vec3 toward_sky = reflect(-toward_eye, normal);
    float low = 1.0 - max(dot(toward_sky, up), 0.0);
    toward_sky += up * (1.2 * sqrt(waves.variance) * low * low * low + max(0.02 - dot(toward_sky, up), 0.0));
    vec3 mirror = sky_toward(normalize(toward_sky), up) * air;

    float under_view = 1.0 / refracted_cosine(max(dot(up, toward_eye), 0.0));
    float under_sun = 1.0 / refracted_cosine(cos_sun);
    vec3 clear = exp(-sea.dimming.rgb * (depth * (under_view + under_sun)));
    vec4 lit = at_pixel(lit_ground_of);
    vec3 floor_light = ground_light(lit, sunlight, skylight);
    // Over shelves the water is fuller of life, by the shore of sand.
    vec3 own = mix(sea.color.rgb * mix(vec3(1.0), vec3(1.3, 1.7, 1.3), exp(-depth / 200.0)), vec3(0.040, 0.130, 0.135),
                   0.6 * exp(-depth / 14.0));
    vec3 body = own * (sun_level * cos_sun + skylight);
    vec3 water = mix(body, floor_light, clear);

    // Foam: at the water's edge, and where crests break.
    float edge = fwidth(depth);
    float wash = (1.0 - smoothstep(0.05, 0.7 + 2.0 * waves.crest, depth)) * clamp(0.8 / (edge + 1e-4), 0.0, 1.0);
    float foam = wash * smoothstep(-0.12, 0.1, waves.crest / max(shoal, 0.05) * 0.5 + 0.05 - 0.1 * depth) * step(0.0, sea.dimming.w);
    foam = max(foam, smoothstep(sea.dimming.w, 1.35 * sea.dimming.w, waves.crest) * step(1e-4, sea.dimming.w));
    vec3 foamy = 0.55 * (sun_level * max(dot(normal, view.sun.xyz), 0.0) + skylight);

    light = mix(water, mirror, mirrored) + sun_level * (glint(normal, toward_eye, up, waves.variance) * smoothstep(0.0, 0.25, depth));
    light = mix(light, foamy, 0.85 * foam);
    float open_water = at_pixel(water_of).r;
    light = mix(floor_light, light, mix(1.0, open_water, smoothstep(0.5, 2.0, depth)));
  } else {
    vec3 ray = -toward_eye;
    if (dot(ray, normal) < 0.0) normal = normalize(normal - ray * (dot(ray, normal) - 0.01));
    vec3 toward_sky = refract(ray, -normal, kWater);
    vec3 inside = sea.color.rgb * 2.0 * (sun_level * cos_sun + skylight);
    if (dot(toward_sky, toward_sky) > 0.0 && dot(toward_sky, up) > 0.0) {
      float mirrored = 0.02 + 0.98 * pow(1.0 - max(dot(toward_sky, normal), 0.0), 5.0);
      float spread = 0.11 * waves.variance + 4e-5;
      float sun = exp((dot(toward_sky, view.sun.xyz) - 1.0) * 2.0 / spread) / spread;
      light = mix(sky_toward(toward_sky, up) * air + sun_level * sun, inside, mirrored);
    } else {
      light = inside;
    }
  }
  light = through_effects(added_by_effects(light, place) + shading.haze, place);
  color = vec4(light, 1.0);
}
