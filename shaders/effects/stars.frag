in vec2 from_middle;
flat in vec3 light;

out vec4 color;

const float kWidth = 0.33;  // of the image's bell, in radii of the quad: 1 % is left at its edge

void main() {
  // As much light in all whatever the place between pixels.
  float r2 = dot(from_middle, from_middle);
  if (r2 > 1.0) discard;
  color = vec4(light * exp(-0.5 * r2 / (kWidth * kWidth)), 0.0);
}
