// The layer of clouds as a cap of a sphere about the eye's vertical: rings that widen with their distance, sectors over the part of
// the horizon that is in view. Corners are lifted so that the triangles' middles, not they, touch the sphere.
#define OUT(type) out type
#include "lib/air_light.glsl"
#include "effects/clouds.glsl"
#include "lib/view.glsl"

layout(location = 0) uniform vec3 ahead;   // level, toward the middle sector, in round space
layout(location = 1) uniform vec4 cap;     // angle of the last ring from the vertical, growth of the rings' exponent, half the sectors' angle

out Layer {
  centroid vec3 sunlight;  // on level cloud with the sun in the zenith, as much of it as reaches the eye
  centroid vec3 skylight;
  centroid vec3 haze;
  centroid vec3 left;
  centroid vec3 relative;  // metres from the eye
} layer;

float ring_angle(float ring) { return cap.x * (exp(cap.y * ring / float(RINGS)) - 1.0) / (exp(cap.y) - 1.0); }

void main() {
  int ring = gl_VertexID / (SECTORS + 1);
  int sector = gl_VertexID - ring * (SECTORS + 1);
  float angle = ring_angle(float(ring));
  float turn = cap.z * (2.0 * float(sector) / float(SECTORS) - 1.0);
  vec3 up = normalize(view.eye_km.xyz);
  vec3 out_from_axis = ahead * cos(turn) + cross(up, ahead) * sin(turn);
  float radius_m = clouds.layer.x * 1e3;
  float across = 0.5 * (ring_angle(float(ring) + 1.0) - angle);
  float along = sin(angle) * cap.z / float(SECTORS);
  float lift_m = 0.5 * radius_m * (across * across + along * along);
  float half_sine = sin(0.5 * angle);
  vec3 round_m = out_from_axis * ((radius_m + lift_m) * sin(angle)) -
                 up * (clouds.layer.z - lift_m + 2.0 * (radius_m + lift_m) * half_sine * half_sine);
  vec3 relative = round_m / view.rounding.xxy;
  gl_Position = view.clip_from_relative * vec4(relative, 1.0);

  float height_m = (clouds.layer.x - clouds.layer.y) * 1e3;
  AirLight light = air_light(relative, height_m);
  // High up the sun sets later than on the ground, which air_light() has in mind.
  if (view.rounding.z > 0.0) {
    layer.sunlight = view.sun.w * 0.3183099 * light.left * sun_transmittance(height_m * 1e-3, light.cos_sun, clouds.layer.y);
  } else {
    float dip = sqrt(2.0 * (clouds.layer.x - clouds.layer.y) / clouds.layer.y);
    layer.sunlight = view.sun.w * 0.3183099 * light.left * smoothstep(-0.01, 0.01, light.cos_sun + dip);
  }
  layer.skylight = light.skylight;
  layer.haze = light.haze;
  layer.left = light.left;
  layer.relative = relative;
}
