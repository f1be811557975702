#define OUT(type) out type
#include "lib/atmosphere.glsl"
#include "lib/sky_map.glsl"
#include "lib/shown_light.glsl"
#include "lib/view.glsl"
#ifdef EFFECTS
#include "effects.glsl"
#endif

layout(binding = 4) uniform sampler2D sky_map;
layout(location = 0) uniform vec2 size;  // texels of the map

in vec3 ray;
out vec4 color;

const float kCosSunRadius = 0.9999892;  // 0.266 degrees

void main() {
  vec3 true_direction = normalize(ray);
  vec3 light = vec3(0.0);
  if (view.rounding.z > 0.0) {
    vec3 direction = normalize(ray * view.rounding.xxy);
    float radius = length(view.eye_km.xyz);
    vec3 up = view.eye_km.xyz / radius;
    float cos_zenith = dot(direction, up);
    vec2 bounds = sky_bounds(radius, view.eye_km.w, view.eye_km.w + kAirTop);
    vec3 sun = view.sun.xyz;
    vec3 level = direction - up * cos_zenith;
    vec3 toward_sun = sun - up * dot(sun, up);
    float cos_azimuth = dot(level, toward_sun) * inversesqrt(max(dot(level, level) * dot(toward_sun, toward_sun), 1e-12));
    vec2 place = vec2(sky_column(clamp(cos_azimuth, -1.0, 1.0)), sky_row(cos_zenith, bounds));
    vec4 sky = texture(sky_map, (place * (size - 1.0) + 0.5) / size);
    light = with_mie(sky, dot(direction, sun));
    light *= view.sun.w * (cos_zenith <= bounds.y ? 1.0 : 0.0);
  }
  float beside = dot(true_direction, view.sun.xyz);
  light += view.sun_at_eye.xyz * view.sun.w * 60.0 * smoothstep(kCosSunRadius, kCosSunRadius + 4e-6, beside);
  light *= view.rounding.w;
#ifdef EFFECTS
  light = sky_through_effects(light, true_direction);
#endif
  color = vec4(shown_light(light), 1.0);
}
