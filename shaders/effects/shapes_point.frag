#include "lib/marked_light.glsl"

layout(location = 0) uniform vec4 ink;    // colour as the screen shows it; w: opacity of the halo
layout(location = 1) uniform vec4 sizes;  // as in the vertex shader

in vec2 from_middle;
flat in vec2 shown;

out vec4 color;

void main() {
  float away = length(from_middle);
  float disc = clamp(shown.x + 0.5 - away, 0.0, 1.0);
  float halo = clamp(shown.x + sizes.x + 0.5 - away, 0.0, 1.0) * ink.w;
  float cover = disc + halo * (1.0 - disc);
  if (cover * shown.y <= 0.0) discard;
  color = vec4(light_shown_as(mix(vec3(0.02), ink.rgb, disc / cover)), cover * shown.y);
}
