// What the sea does to the light on its floor, seen from under water (globe/effects/sea.cpp).
#include "effects/sea_block.glsl"

// Cosine of a ray's angle from the vertical below the surface.
float refracted_cosine(float cosine) { return sqrt(1.0 - (1.0 - cosine * cosine) / (kWater * kWater)); }

// How much the waves gather the sunlight at a depth: the inverse of what they make of a patch of it, for small slopes. The Hessian of
// their height is H; a depth d turns level places into (1 - d (1 - 1/n) H) of them.
// `right`, `ahead`: what the offset changes by from pixel to pixel.
float caustics(vec3 offset, vec3 right, vec3 ahead, float depth) {
  float level_2 = level_part_2(offset);
  vec3 up = normalize(view.eye_km.xyz);
  vec3 axis = normalize(cross(up, abs(up.z) < 0.7 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec3 other = cross(up, axis);
  vec3 hessian = vec3(0.0);  // xx, xy, yy
  for (int k = 0; k < int(sea.level.x); ++k) {
    vec3 along = sea.along[k].xyz;
    float number = sea.along[k].w;
    float share = pixel_share(number * (abs(dot(right, along)) + abs(dot(ahead, along))));
    float way = wave_way(offset, level_2, along, sea.form[k].z, sea.level.y);
    // Of short waves the light has crossed over far above.
    share *= exp(-0.02 * depth * number);
    float bend = share * sea.form[k].x * number * number * cos(number * way + sea.form[k].y);
    vec2 to = vec2(dot(along, axis), dot(along, other));
    hessian -= bend * vec3(to.x * to.x, to.x * to.y, to.y * to.y);
  }
  hessian *= depth * (1.0 - 1.0 / kWater);
  float area = (1.0 + hessian.x) * (1.0 + hessian.z) - hessian.y * hessian.y;
  return mix(1.0, min(1.0 / max(abs(area), 0.22), 3.5), exp(-depth / 18.0));
}

void sea_dim(inout vec3 sunlight, inout vec3 skylight, Place place) {
  if (sea.level.w == 0.0) return;
  vec3 offset = sea_offset(place.relative);
  vec3 right = dFdx(offset);
  vec3 ahead = dFdy(offset);
  if (place.height >= 0.0) return;
  float depth = -place.height;
  float cos_sun = refracted_cosine(max(dot(place.up, view.sun.xyz), 0.0));
  vec3 aside = (view.sun.xyz - place.up * dot(place.up, view.sun.xyz)) * (depth / (kWater * cos_sun));
  sunlight *= exp(-sea.dimming.rgb * (depth / cos_sun)) * caustics(offset + aside, right, ahead, depth);
  skylight *= exp(-sea.dimming.rgb * (1.2 * depth));
}
