// Images of the sun that reflections in a lens throw along the line through the picture's middle: one quad each.
layout(binding = 0) uniform sampler2D seen_sun;
layout(location = 0) uniform vec4 sun;    // its place in the picture, [-1, 1]; aspect of the picture; strength
layout(location = 1) uniform vec4 ghost[GHOSTS];  // place on the line (1: the sun, 0: the middle), half size, ring (0 disc, 1 ring), share of the light
layout(location = 32) uniform vec3 tint[GHOSTS];

out vec2 from_middle;
flat out vec3 light;
flat out float ring;

void main() {
  vec4 one = ghost[gl_InstanceID];
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  from_middle = corner;
  // Fades as the sun leaves the picture.
  float inside = 1.0 - smoothstep(0.8, 1.0, max(abs(sun.x), abs(sun.y)));
  light = texelFetch(seen_sun, ivec2(0), 0).rgb * tint[gl_InstanceID] * (one.w * sun.w * inside);
  ring = one.z;
  gl_Position = vec4(sun.xy * one.x + corner * one.y * vec2(1.0 / sun.z, 1.0), 0.0, 1.0);
}
