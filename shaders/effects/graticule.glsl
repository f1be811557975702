// Meridians and parallels (globe/effects/graticule.cpp).
#include "lib/map_place.glsl"
#include "lib/marked_light.glsl"

layout(std140, binding = GRATICULE_BLOCK) uniform Graticule {
  MapEye eye;
  vec4 color;     // as the screen shows it; w: opacity
  vec4 lines;     // the eye's longitude and latitude from the nearest line, in steps; the step in radians; width in pixels
  ivec4 numbers;  // of that meridian and parallel, in the period in which one line is not a finer one; the period; 1000 times what is seen
                  // of finer lines
} graticule;

// How much of a pixel lines cover, and their dark borders, that lie `gap` pixels apart, `away` pixels from the nearest.
vec2 graticule_cover(float away, float gap) {
  float half_width = 0.5 * graticule.lines.w;
  float line = clamp(half_width + 0.5 - away, 0.0, min(graticule.lines.w, 1.0));
  return vec2(line, clamp(half_width + 1.5 - away, 0.0, 1.0)) * smoothstep(4.0, 12.0, gap);
}

float graticule_share(int number, int nearest) {
  return abs(number + nearest) % graticule.numbers.z == 0 ? 1.0 : float(graticule.numbers.w) * 1e-3;
}

vec3 graticule_add(vec3 light, Place place) {
  MapPlace at = map_place(graticule.eye, place.relative);
  vec3 right = dFdx(place.relative);
  vec3 up = dFdy(place.relative);
  vec2 east_px = vec2(dot(at.east, right), dot(at.east, up));
  vec2 north_px = vec2(dot(at.north, right), dot(at.north, up));
  vec2 metres = vec2(at.axis, at.meridian) * graticule.lines.z;  // from line to line
  vec2 gap = metres / max(vec2(length(east_px), length(north_px)), 1e-9);
  vec2 steps = at.offset / graticule.lines.z + graticule.lines.xy;
  vec2 nearest = round(steps);
  vec2 away = abs(steps - nearest) * gap;
  vec2 meridian = graticule_cover(away.x, gap.x) * graticule_share(graticule.numbers.x, int(nearest.x));
  vec2 parallel = graticule_cover(away.y, gap.y) * graticule_share(graticule.numbers.y, int(nearest.y));
  vec2 cover = max(meridian, parallel) * graticule.color.w;
  return marked_light(marked_light(light, vec3(0.02), 0.3 * cover.y), graticule.color.rgb, cover.x);
}
