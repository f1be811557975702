// Directions through points of a picture in a camera's axes (right, up, forward), plain GLSL of plain arguments: the tests compile
// this file as C++ too. `at` counts half picture heights from the middle, to the right and up.

// Equidistant: the angle from the axis grows as the distance from the middle. render::direction_through has the same in double.
vec3 fisheye_direction(vec2 at, float half_fov) {
  float radius = length(at);
  float angle = half_fov * radius;
  float aside = radius > 1e-6f ? sin(angle) / radius : half_fov;
  return vec3(at.x * aside, at.y * aside, cos(angle));
}

vec3 equirectangular_direction(vec2 at, float half_fov) {
  float around = half_fov * at.x;
  float above = half_fov * at.y;
  return vec3(sin(around) * cos(above), sin(above), cos(around) * cos(above));
}

// Which face of the cube around the eye a direction meets: 0, 1 right and left, 2, 3 up and down, 4, 5 ahead and behind.
int cube_face(vec3 direction) {
  float x = abs(direction.x);
  float y = abs(direction.y);
  float z = abs(direction.z);
  if (z >= x && z >= y) return direction.z > 0.0f ? 4 : 5;
  if (x >= y) return direction.x > 0.0f ? 0 : 1;
  return direction.y > 0.0f ? 2 : 3;
}
