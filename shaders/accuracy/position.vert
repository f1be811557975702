// Ways to bring a vertex to the camera that the globe does not take, for app/accuracy/position_yardsticks.cpp. Positions are ECEF
// metres; every way ends with metres from the camera in one float a coordinate.

layout(std140, binding = 0) uniform Eye {
  mat4 clip_from_relative;
  vec4 high;         // the camera, split as the vertices are
  vec4 low;
  uvec4 low_words;   // its doubles
  uvec4 high_words;
  vec4 offset;       // anchor - camera, rounded once
} eye;

#ifdef DOUBLE
layout(location = 0) in uvec3 high;  // words of doubles
layout(location = 1) in uvec3 low;
#else
layout(location = 0) in vec3 high;
#ifdef SPLIT
layout(location = 1) in vec3 low;
#endif
#endif

invariant gl_Position;

vec3 from_camera() {
#if defined(DOUBLE)
  dvec3 place = dvec3(packDouble2x32(uvec2(low.x, high.x)), packDouble2x32(uvec2(low.y, high.y)),
                      packDouble2x32(uvec2(low.z, high.z)));
  dvec3 camera = dvec3(packDouble2x32(uvec2(eye.low_words.x, eye.high_words.x)),
                       packDouble2x32(uvec2(eye.low_words.y, eye.high_words.y)),
                       packDouble2x32(uvec2(eye.low_words.z, eye.high_words.z)));
  return vec3(place - camera);
#elif defined(TWO_SUM)
  // The sum of two floats with its rounding error (Knuth 1997, The Art of Computer Programming 2, 4.2.2, theorem B), then the low
  // parts: subtraction in double-single arithmetic (Dekker 1971).
  precise vec3 sum = high - eye.high.xyz;
  precise vec3 part = sum - high;
  precise vec3 rounded_off = (high - (sum - part)) - (eye.high.xyz + part);
  precise vec3 result = sum + (rounded_off + (low - eye.low.xyz));
  return result;
#elif defined(SPLIT)
  precise vec3 result = (high - eye.high.xyz) + (low - eye.low.xyz);
  return result;
#elif defined(ANCHORED)
  precise vec3 result = high + eye.offset.xyz;
  return result;
#else
  precise vec3 result = high - eye.high.xyz;
  return result;
#endif
}

void main() {
  precise vec4 clip = eye.clip_from_relative * vec4(from_camera(), 1.0);
  gl_Position = clip;
}
