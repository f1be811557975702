#include "effects.glsl"
#include "effects/clouds.glsl"
#include "lib/view.glsl"

layout(location = 2) uniform int seen_from;  // 1: above, 0: below

in Layer {
  centroid vec3 sunlight;
  centroid vec3 skylight;
  centroid vec3 haze;
  centroid vec3 left;
  centroid vec3 relative;
} layer;

out vec4 color;

void main() {
  vec3 round = normalize(view.eye_km.xyz + layer.relative * 1e-3 * view.rounding.xxy);
  vec3 up = normalize(round * view.rounding.xxy);
  float away = length(layer.relative);
  vec3 ray = layer.relative / away;
  float steep = abs(dot(ray, up));
  float footprint = away * 1e-3 * clouds.cover.w * inversesqrt(max(steep, 0.04));
  CloudHere cloud = cloud_at(up, footprint);
  float cover = clouds.color.w * (1.0 - exp(-cloud.depth / max(steep, 0.12)));
  // Near the eye the layer is mist, not a sheet.
  cover *= smoothstep(0.0, 1.0, away / clouds.layer.w);
  vec3 light = cloud_light(cloud, layer.sunlight, layer.skylight, dot(up, view.sun.xyz), dot(ray, view.sun.xyz), seen_from != 0);
  Place place = Place(layer.relative, up, round, (clouds.layer.x - clouds.layer.y) * 1e3, layer.left);
  light = through_effects(light + layer.haze, place);
  color = vec4(light * cover, cover);
}
