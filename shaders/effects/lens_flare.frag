in vec2 from_middle;
flat in vec3 light;
flat in float ring;

out vec4 color;

void main() {
  float r = length(from_middle);
  float disc = (1.0 - smoothstep(0.85, 1.0, r)) * (0.35 + 0.65 * r * r);
  float halo = exp(-60.0 * (r - 0.8) * (r - 0.8));
  float glow = max(exp(-5.0 * r) - exp(-5.0), 0.0);
  color = vec4(light * (ring < 0.5 ? disc : ring < 1.5 ? halo : glow), 0.0);
}
