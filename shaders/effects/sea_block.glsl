// The sea as all its shaders know it (globe/effects/sea.cpp, SeaBlock).
#include "lib/view.glsl"
#include "lib/waves.glsl"

const float kWater = 1.333;  // index of refraction

layout(std140, binding = SEA_BLOCK) uniform Sea {
  vec4 level;        // waves, radius of round space in metres, sum of amplitudes, 1 where the eye is under water
  vec4 color;        // of deep water as an albedo; w: slope variance of what is shorter than the waves
  vec4 dimming;      // per metre of water; w: crests steeper than this break
  vec4 along[MAX_WAVES];  // longest wave first; which way it runs at the nadir (round space); w: radians per metre
  vec4 form[MAX_WAVES];   // amplitude, phase at the nadir, cotangent of the angle to the source; w: slope variance of this and shorter waves
} sea;

// From the nadir, round space.
vec3 sea_offset(vec3 relative_m) { return relative_m * view.rounding.xxy; }

float level_part_2(vec3 offset) {
  float rise = dot(offset, view.eye_km.xyz) / length(view.eye_km.xyz);
  return max(dot(offset, offset) - rise * rise, 0.0);
}
