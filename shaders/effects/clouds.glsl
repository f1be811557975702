// The layer of clouds (globe/effects/clouds.cpp): what it is made of at a place, its shadows, and the mist of an eye inside it.
#ifndef OUT
#define OUT(type) out type
#endif
#include "lib/atmosphere.glsl"
#include "lib/place.glsl"
#include "lib/view.glsl"

layout(std140, binding = CLOUDS_BLOCK) uniform Clouds {
  vec4 color;   // albedo; w: opacity, the share of light that the thickest cloud takes
  vec4 layer;   // radius of the layer in round space, of the planet there (km), height of the eye over the layer, half its thickness (m)
  vec4 cover;   // potential at which clouds begin, gain from there to the thickest, optical depth of the thickest, size of a pixel (radians)
  vec4 turned;  // cosine and sine of the way the layer has gone around the axis; z: 1 with the eye inside it; w: texels of a face
  vec4 detail;  // tiles of the coarser and of the finer detail to half a face, their shares of the potential
} clouds;
layout(binding = CLOUDS_UNIT) uniform sampler2DArray cloud_cover;    // six faces of a cube: potential, and its gradient over the sphere
layout(binding = CLOUDS_UNIT + 1) uniform sampler2D cloud_detail;    // repeats: potential, and its gradient over the tile

const float kGradientRange = 128.0;  // of the cover, by a radian
const float kDetailRange = 24.0;     // of the detail, by a tile

struct CloudHere {
  float depth;       // optical, straight through
  float toward_sun;  // rise of its top toward the sun
};

vec3 in_cloud_frame(vec3 v) {
  return vec3(clouds.turned.x * v.x + clouds.turned.y * v.y, clouds.turned.x * v.y - clouds.turned.y * v.x, v.z);
}

// A direction with its components turned so that axis k comes first.
vec3 from_axis(vec3 v, int k) { return k == 0 ? v : k == 1 ? v.yzx : v.zxy; }

// `up` is the vertical, of length 1, in the world's axes; `footprint_km` of a pixel there.
CloudHere cloud_at(vec3 up_of_place, float footprint_km) {
  vec3 up = in_cloud_frame(up_of_place);
  vec3 sun = in_cloud_frame(view.sun.xyz);
  vec3 size = abs(up);
  int first = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  vec3 turned = from_axis(up, first);
  vec2 place = turned.yz / abs(turned.x);

  float texel_km = 2.0 * clouds.layer.y / clouds.turned.w;
  float level = clamp(floor(log2(max(footprint_km / texel_km, 1e-3)) + 1.0), 0.0, 8.0);
  float texels = clouds.turned.w * exp2(-level);
  vec2 at = ((place * 0.5 + 0.5) * (texels - 1.0) + 0.5) / texels;  // texel centres of the border lie on the cube's edges
  vec4 cover = textureLod(cloud_cover, vec3(at, 2 * first + (turned.x < 0.0 ? 1 : 0)), level);
  float potential = cover.r;
  float rise = dot(cover.gba * 2.0 - 1.0, sun) * kGradientRange;

  // Near by a finer fractal breaks the edges up. It lies on the faces of the cube, blended over their edges; loops of no turns
  // cost nothing.
  float near = 1.0 - smoothstep(0.5, 2.5, footprint_km);
  float nearer = 1.0 - smoothstep(0.05, 0.3, footprint_km);
  int second = size[(first + 1) % 3] >= size[(first + 2) % 3] ? (first + 1) % 3 : (first + 2) % 3;
  int third = 3 - first - second;
  float beside = smoothstep(0.93, 1.0, size[second] / size[first]);
  float beside_too = smoothstep(0.93, 1.0, size[third] / size[first]);
  int charts = near > 0.0 ? 1 + int(beside > 0.0) + int(beside_too > 0.0) : 0;
  float whole = 1.0 / (1.0 + beside + beside_too);
  float fine_rise = 0.0;
  for (int k = 0; k < (nearer > 0.0 ? 2 * charts : charts); ++k) {
    int chart = k % max(charts, 1);
    bool fine = k >= charts;
    vec3 a = from_axis(up, chart == 0 ? first : chart == 1 ? second : third);
    vec3 s = from_axis(sun, chart == 0 ? first : chart == 1 ? second : third);
    float inverse = 1.0 / abs(a.x);
    float tiles = fine ? clouds.detail.y : clouds.detail.x;
    vec2 uv = a.yz * inverse;
    vec2 change = (s.yz - uv * (s.x * sign(a.x))) * inverse;  // of uv toward the sun, by a radian
    float texel = clouds.layer.y / (tiles * 512.0);
    vec4 here = textureLod(cloud_detail, uv * tiles + (fine ? 0.37 : 0.0), floor(log2(max(footprint_km / texel, 1.0)) + 0.5));
    float share = whole * (chart == 0 ? 1.0 : chart == 1 ? beside : beside_too) *
                  (fine ? clouds.detail.w * nearer : clouds.detail.z * near);
    potential += share * (here.r * 2.0 - 1.0);
    fine_rise += share * tiles * kDetailRange * dot(here.gb * 2.0 - 1.0, change);
  }

  float rest = (potential - clouds.cover.x) * clouds.cover.y * (1.0 + 0.5 * near);  // near by edges are seen to be sharp
  float dense = clamp(rest, 0.0, 1.0);
  CloudHere cloud;
  cloud.depth = clouds.cover.z * dense * dense;
  // The shape that a satellite sees is broad, that of a heap steep: each by its own height in kilometres.
  float steepness = (9.0 * rise + 0.42 * fine_rise) * clouds.cover.y / clouds.layer.y;
  cloud.toward_sun = steepness * (1.0 - smoothstep(1.0, 1.6, rest));
  return cloud;
}

// Share of the light that comes through to the other side, after any number of scatterings (two streams, asymmetry 0.73).
float cloud_passes(float depth) { return 1.0 / (1.0 + 0.2 * depth); }

void clouds_dim(inout vec3 sunlight, inout vec3 skylight, Place place) {
  float radius = clouds.layer.y + place.height * 1e-3;
  float higher = clouds.layer.x - radius;
  vec3 sun = normalize(view.sun.xyz * view.rounding.xxy);
  float along = radius * dot(place.round, sun);
  float way = -along + sqrt(max(along * along + higher * (clouds.layer.x + radius), 0.0));
  vec3 up = normalize((place.round * radius + sun * way) * view.rounding.xxy);
  vec3 ray = place.relative * 1e-3;
  float footprint = length(ray) * clouds.cover.w;
  CloudHere cloud = cloud_at(up, footprint);
  float dark = clouds.color.w * (1.0 - cloud_passes(cloud.depth));
  dark *= higher > 0.0 ? 1.0 : 0.0;
  sunlight *= 1.0 - dark;
  skylight *= 1.0 - 0.35 * dark;
}

// Light of a cloud that is lit by the sun (`sunlight` with it in the zenith, `cos_sun` of its zenith angle) and the sky.
vec3 cloud_light(CloudHere cloud, vec3 sunlight, vec3 skylight, float cos_sun, float cos_view, bool above) {
  float passes = cloud_passes(cloud.depth);
  float facing = max(cos_sun, 0.0);
  float phase = 0.6 * pow(max(cos_view, 0.0), 6.0) + 3.0 * pow(max(cos_view, 0.0), 60.0);  // forward, through thin cloud
  float relief = clamp(-cloud.toward_sun * inversesqrt(1.0 + cloud.toward_sun * cloud.toward_sun), -1.0, 1.0);
  vec3 light;
  if (above) {
    // Light that has been scattered often softens the relief.
    float lit = (0.16 + 0.68 * facing) * (1.0 - 0.45 * passes) + 0.5 * relief * (1.0 - 0.5 * facing);
    light = sunlight * max(lit, 0.10 + 0.25 * facing) + skylight;
  } else {
    float lit = (0.10 + 0.45 * facing) * passes * (1.0 + 0.4 * relief) + phase * exp(-0.9 * cloud.depth);
    light = sunlight * lit + skylight * (0.25 + 0.45 * passes);
  }
  return clouds.color.rgb * light;
}

// From inside the layer everything is seen through mist.
vec3 clouds_through(vec3 light, vec3 relative_m) {
  vec3 after = light;
  for (int k = 0; k < int(clouds.turned.z); ++k) {
    vec3 up = normalize(view.eye_km.xyz);
    CloudHere cloud = cloud_at(normalize(up * view.rounding.xxy), 0.02);
    vec3 ray = relative_m * view.rounding.xxy;
    float away = length(ray);
    float rise = dot(ray, up) / max(away, 1e-3);
    float room = rise > 0.0 ? clouds.layer.w - clouds.layer.z : clouds.layer.w + clouds.layer.z;
    float inside = min(min(away, room / max(abs(rise), 1e-4)), 4000.0);
    float deep = 1.0 - abs(clouds.layer.z) / clouds.layer.w;  // thins out toward its faces
    float left = exp(-cloud.depth * deep / clouds.layer.w * inside * clouds.color.w);
    float height = clouds.layer.x - clouds.layer.y;
    float cos_sun = dot(up, view.sun.xyz);
    vec3 sunlight = vec3(view.sun.w * 0.3183099);
    vec3 skylight = sunlight * 0.1;
    if (view.rounding.z > 0.0) {
      skylight = sunlight * sky_irradiance(height, cos_sun);
      sunlight *= sun_transmittance(height, cos_sun, clouds.layer.y);
    }
    CloudHere half_way = CloudHere(cloud.depth * (0.5 - 0.5 * clouds.layer.z / clouds.layer.w), 0.0);
    vec3 mist = cloud_light(half_way, sunlight, skylight, cos_sun, 0.0, false) * view.rounding.w;
    after = mix(mist, after, left);
  }
  return after;
}
