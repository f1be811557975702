#define OUT(type) out type
#include "lib/atmosphere.glsl"
#include "lib/sky_map.glsl"
#include "lib/view.glsl"

layout(location = 0) uniform vec2 size;  // texels

out vec4 light;

void main() {
  // Texel centres of the border stand for the ends of both ranges.
  vec2 place = (gl_FragCoord.xy - 0.5) / (size - 1.0);
  vec3 eye = view.eye_km.xyz;
  float radius = length(eye);
  vec3 up = eye / radius;
  float ground = view.eye_km.w;
  float top = ground + kAirTop;
  vec3 sun = view.sun.xyz;
  vec3 toward_sun = sun - up * dot(sun, up);
  vec3 ahead = dot(toward_sun, toward_sun) > 1e-8 ? normalize(toward_sun) : normalize(cross(up, vec3(up.y, up.z, up.x)));
  vec3 aside = cross(up, ahead);
  float cos_zenith = cos_zenith_of_row(place.y, sky_bounds(radius, ground, top));
  float sin_zenith = sqrt(max(1.0 - cos_zenith * cos_zenith, 0.0));
  float cos_azimuth = cos_azimuth_of_column(place.x);
  float sin_azimuth = sqrt(max(1.0 - cos_azimuth * cos_azimuth, 0.0));
  vec3 direction = up * cos_zenith + (ahead * cos_azimuth + aside * sin_azimuth) * sin_zenith;

  float along = dot(eye, direction);
  vec3 nearest = eye - direction * along;
  float half_chord = sqrt(max(top * top - dot(nearest, nearest), 0.0));
  float from = max(-along - half_chord, 0.0);
  float to = max(-along + half_chord, 0.0);
  light = sky_light(eye, direction, from, to, sun, ground, SKY_STEPS);
}
