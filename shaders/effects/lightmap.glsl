// Light of the ground by a map of the planet (globe/effects/lightmap.cpp).
#include "lib/lat_long.glsl"
#include "lib/place.glsl"
#include "lib/view.glsl"

layout(std140, binding = LIGHTMAP_BLOCK) uniform Lightmap {
  vec4 map;  // share of it in the light, size of a pixel (radians)
} lightmap;
layout(binding = LIGHTMAP_UNIT) uniform sampler2D lightmap_light;

void lightmap_dim(inout vec3 sunlight, inout vec3 skylight, Place place) {
  float footprint = length(place.relative) * 1e-3 / view.eye_km.w * lightmap.map.y;
  vec3 light = textureLod(lightmap_light, lat_long_place(place.up), lat_long_level(lightmap_light, footprint)).rgb;
  vec3 share = mix(vec3(1.0), light, lightmap.map.x);
  sunlight *= share;
  skylight *= share;
}
