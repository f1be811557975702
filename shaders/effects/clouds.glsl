// The layer of clouds (globe/effects/clouds.cpp): what it is made of at a place, its shadows, and the mist of an eye inside it.
#include "lib/place.glsl"
#include "lib/view.glsl"

// A look at the detail: a square that repeats, laid on the plane that touches the planet near the eye.
struct Detail {
  vec4 chart[3];  // the plane's normal and its axes, these by the square's side; xyz in the world's axes
  vec4 sun;       // toward it in that chart; w: share of the potential
};

layout(std140, binding = CLOUDS_BLOCK) uniform Clouds {
  vec4 color;   // albedo; w: opacity, the share of light that the thickest cloud takes
  vec4 layer;   // radius of the layer in round space, of the planet there (km), height of the eye over the layer, half its thickness (m)
  vec4 cover;   // potential at which clouds begin, gain from there to the thickest, optical depth of the thickest, size of a pixel (radians)
  vec4 turned;  // cosine and sine of the way the layer has gone around the axis, texels of a face; w: 1 for clouds that are made up
  vec4 sun;     // toward it in the cover's frame; w: looks at the broader detail
  vec4 round_sun;  // toward it in round space; w: looks at detail
  vec4 mist;    // its light; w: extinction by metre, 0 for an eye outside the layer
  Detail detail[4];
} clouds;
layout(binding = CLOUDS_UNIT) uniform sampler2DArray cloud_cover;    // six faces of a cube: potential, and its gradient over the sphere
layout(binding = CLOUDS_UNIT + 1) uniform sampler2D cloud_detail;    // repeats: potential, and its gradient over the square

const float kGradientRange = 128.0;  // of the cover, by a radian
const float kDetailRange = 24.0;     // of the detail, by a side

struct CloudHere {
  float depth;       // optical, straight through
  float toward_sun;  // rise of its top toward the sun
};

// What the weather makes of a direction of any length in the world's axes: potential, and its rise toward the sun by a radian.
vec2 broad_cloud(vec3 direction, float footprint_km) {
  vec3 d = vec3(clouds.turned.x * direction.x + clouds.turned.y * direction.y, clouds.turned.x * direction.y - clouds.turned.y * direction.x,
                direction.z);
  vec3 size = abs(d);
  bool x = size.x >= max(size.y, size.z);
  bool y = size.y >= size.z;
  vec3 turned = x ? d : y ? d.yzx : d.zxy;
  float face = (x ? 0.0 : y ? 2.0 : 4.0) + (turned.x < 0.0 ? 1.0 : 0.0);
  float level = clamp(floor(log2(footprint_km * clouds.turned.z / clouds.layer.y)), 0.0, 8.0);
  float texels = clouds.turned.z * exp2(-level);
  // Texel centres of the border lie on the cube's edges.
  vec2 at = ((turned.yz / abs(turned.x) * 0.5 + 0.5) * (texels - 1.0) + 0.5) / texels;
  vec4 cover = textureLod(cloud_cover, vec3(at, face), level);
  return vec2(cover.r, dot(cover.gba * 2.0 - 1.0, clouds.sun.xyz) * kGradientRange);
}

// The same of a finer fractal that breaks edges up near by.
vec2 fine_cloud(int look, vec3 direction) {
  vec3 d = vec3(dot(direction, clouds.detail[look].chart[0].xyz), dot(direction, clouds.detail[look].chart[1].xyz),
                dot(direction, clouds.detail[look].chart[2].xyz));
  float inverse = 1.0 / max(d.x, 1e-3);
  vec2 uv = d.yz * inverse;
  vec4 sun = clouds.detail[look].sun;
  vec4 here = texture(cloud_detail, uv);
  vec2 change = (sun.yz - uv * sun.x) * (inverse * length(direction));
  return sun.w * vec2(here.r * 2.0 - 1.0, kDetailRange * dot(here.gb * 2.0 - 1.0, change));
}

float thickness_of(float potential, float near) {
  // Near by edges are seen to be sharp.
  return (potential - clouds.cover.x) * clouds.cover.y * (1.0 + 0.5 * near);
}

float depth_of(float thickness) {
  float dense = clamp(thickness, 0.0, 1.0);
  return clouds.cover.z * dense * dense;
}

float near_by(float footprint_km) { return 1.0 - smoothstep(0.5, 2.5, footprint_km); }

CloudHere cloud_at(vec3 direction, float footprint_km) {
  vec2 broad = broad_cloud(direction, footprint_km);
  float near = near_by(footprint_km);
  float nearer = 1.0 - smoothstep(0.05, 0.3, footprint_km);
  vec2 fine = near * fine_cloud(0, direction);
  for (int look = 1; look < int(clouds.round_sun.w); ++look)
    fine += (look < int(clouds.sun.w) ? near : nearer) * fine_cloud(look, direction);
  float thickness = thickness_of(broad.x + fine.x, near);
  // The shape that a satellite sees is broad, that of a heap steep: each by its own height in kilometres.
  float steepness = (9.0 * broad.y + 0.42 * fine.y) * clouds.cover.y / clouds.layer.y;
  return CloudHere(depth_of(thickness), steepness * (1.0 - smoothstep(1.0, 1.6, thickness)));
}

// Share of the light that comes through to the other side, after any number of scatterings (two streams, asymmetry 0.73).
float cloud_passes(float depth) { return 1.0 / (1.0 + 0.2 * depth); }

void clouds_dim(inout vec3 sunlight, inout vec3 skylight, Place place) {
  float radius = clouds.layer.y + place.height * 1e-3;
  float higher = clouds.layer.x - radius;
  float along = radius * dot(place.round, clouds.round_sun.xyz);
  float way = -along + sqrt(max(along * along + higher * (clouds.layer.x + radius), 0.0));
  vec3 direction = (place.round * radius + clouds.round_sun.xyz * way) * view.rounding.xxy;
  float footprint = length(place.relative) * 1e-3 * clouds.cover.w;
  float near = near_by(footprint);
  float potential = broad_cloud(direction, footprint).x + near * fine_cloud(0, direction).x;
  for (int look = 1; look < int(clouds.sun.w); ++look) potential += near * fine_cloud(look, direction).x;
  float passes = cloud_passes(depth_of(thickness_of(potential, near)));
  float dark = higher > 0.0 ? clouds.color.w * (1.0 - passes) : 0.0;
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
    float lit = (0.14 + 0.60 * facing) * (1.0 - 0.62 * passes) + 0.45 * relief * (1.0 - 0.5 * facing);
    light = sunlight * max(lit, 0.08 + 0.2 * facing) + skylight;
  } else {
    float lit = (0.10 + 0.45 * facing) * passes * (1.0 + 0.4 * relief) + phase * exp(-0.9 * cloud.depth);
    light = sunlight * lit + skylight * (0.25 + 0.45 * passes);
  }
  return clouds.color.rgb * light;
}

// From inside the layer everything is seen through mist.
vec3 clouds_through(vec3 light, vec3 relative_m) {
  vec3 ray = relative_m * view.rounding.xxy;
  float away = length(ray);
  float rise = dot(ray, view.eye_km.xyz) / (max(away, 1e-3) * clouds.layer.x);
  float room = clouds.layer.w - (rise > 0.0 ? clouds.layer.z : -clouds.layer.z);
  float inside = min(min(away, room / max(abs(rise), 1e-4)), 4000.0);
  return mix(clouds.mist.rgb, light, exp(-clouds.mist.w * inside));
}
