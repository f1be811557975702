// Light of the sun and the sky at a place, and what the air between it and the eye makes of it. For vertex shaders; define OUT(type)
// before.
#include "lib/atmosphere.glsl"
#include "lib/view.glsl"

struct AirLight {
  vec3 sunlight;   // that comes from level ground of albedo 1 with the sun in the zenith, as much of it as reaches the eye
  vec3 skylight;   // the same of the sky's light
  vec3 haze;       // light of the air on the way
  vec3 left;       // share of the light that starts at the place and reaches the eye
  vec3 up;         // vertical of the place, in world space
  vec3 direction;  // toward it, in round space
  float cos_sun;   // of the sun's zenith angle there
};

// `relative_m` from the eye, world axes; `height_m` above the ellipsoid.
AirLight air_light(vec3 relative_m, float height_m) {
  AirLight light;
  vec3 relative_km = relative_m * 1e-3;
  vec3 round_km = relative_km * view.rounding.xxy;  // in round space the air has one thickness everywhere
  // Far off, a vertex in the middle of a long edge lies hundreds of metres inside the planet: for the air it is lifted to its height,
  // or the lattice would show in the haze.
  float height_km = height_m * 1e-3;
  vec3 from_centre = view.eye_km.xyz + round_km;
  if (dot(round_km, round_km) > 400.0) {
    float radius_km = length(from_centre);
    round_km += from_centre * ((view.eye_km.w + height_km) / radius_km - 1.0);
  }
  light.up = normalize((view.eye_km.xyz + round_km) * view.rounding.xxy);
  vec3 sun = view.sun.xyz;
  light.cos_sun = dot(sun, light.up);
  float away = length(round_km);
  light.direction = round_km / max(away, 1e-9);

  if (view.rounding.z > 0.0) {
    float ground = view.eye_km.w;
    // The stretch of the ray inside the air.
    float radius = length(view.eye_km.xyz);
    float along = dot(view.eye_km.xyz, light.direction);
    float top = ground + kAirTop;
    float entry = radius > top ? max(-along - sqrt(max(along * along - radius * radius + top * top, 0.0)), 0.0) : 0.0;
    vec3 sun_here = sun_transmittance(max(height_km, 0.0), light.cos_sun, ground);
    light.haze = view.sun.w * light_before(view.eye_km.xyz, light.direction, min(entry, away), away, sun, light.cos_sun, ground,
                                           HAZE_STEPS, light.left);
    light.sunlight = view.sun.w * light.left * sun_here * 0.3183099;
    light.skylight = view.sun.w * light.left * sky_irradiance(max(height_km, 0.0), light.cos_sun) * 0.3183099;
  } else {
    light.left = vec3(1.0);
    light.haze = vec3(0.0);
    light.sunlight = vec3(view.sun.w * 0.3183099);
    light.skylight = vec3(view.sun.w * 0.3183099 * 0.004);
  }
  // Ground below the sun's horizon is dark whatever its slope, with a penumbra as wide as the sun and the air make it.
  light.sunlight *= smoothstep(-0.03, 0.03, light.cos_sun) * view.rounding.w;
  light.skylight *= view.rounding.w;
  light.haze *= view.rounding.w;
  light.left *= view.rounding.w;
  return light;
}
