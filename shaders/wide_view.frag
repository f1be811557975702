#include "lib/projection.glsl"

// The pixels of a fisheye or a panorama that look through one face of the cube around the eye.

layout(binding = 0) uniform sampler2D face_color;
layout(binding = 1) uniform sampler2D face_depth;

layout(location = 0) uniform vec4 field;    // half the field of view, radians; width by height; width and height of a pixel
layout(location = 1) uniform vec4 face;     // which it is; half its width at distance 1, margin included
layout(location = 2) uniform mat3 to_face;  // from the camera's axes to right, up and forward of the face

in vec2 corner;
out vec4 color;

vec3 direction_at(vec2 at) {
#ifdef FISHEYE
  return fisheye_direction(at, field.x);
#else
  return equirectangular_direction(at, field.x);
#endif
}

vec2 face_place(vec3 direction) {
  vec3 through = to_face * direction;
  return 0.5 + 0.5 * through.xy / (through.z * face.y);
}

void main() {
  vec2 at = vec2(corner.x * field.y, corner.y);
#ifdef FISHEYE
  if (dot(at, at) > 1.0) discard;
#else
  if (abs(at.x) * field.x > 3.14159265) discard;
#endif
  vec3 direction = direction_at(at);
  if (float(cube_face(direction)) != face.x) discard;
  // Texels of a face are up to three times as fine as pixels at its corners: four looks a pixel, on a turned square.
  color = vec4(0.0);
  for (int k = 0; k < 4; ++k) {
    vec2 offset = k == 0 ? vec2(0.125, 0.375) : k == 1 ? vec2(-0.375, 0.125) : k == 2 ? vec2(-0.125, -0.375) : vec2(0.375, -0.125);
    color += 0.25 * textureLod(face_color, face_place(direction_at(at + offset * field.zw)), 0.0);
  }
  // Along the ray, where a face has it along its own axis.
  float depth = texelFetch(face_depth, ivec2(face_place(direction) * vec2(textureSize(face_depth, 0))), 0).r;
  gl_FragDepth = depth * (to_face * direction).z;
}
