// Lambert light on a flat triangle, one bilinear look-up of colour.

layout(binding = 1) uniform sampler2D colors;

in vec3 field_position;
in vec2 color_uv;

out vec4 color;

void main() {
  const vec3 kToSun = vec3(0.48, 0.6, 0.64);
  vec3 normal = normalize(cross(dFdx(field_position), dFdy(field_position)));
  float light = 0.3 + 0.7 * max(dot(normal, kToSun), 0.0);
  color = vec4(texture(colors, color_uv).rgb * light, 1.0);
}
