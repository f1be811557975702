// Lines of equal height (globe/effects/contours.cpp).
layout(std140, binding = CONTOURS_BLOCK) uniform Contours {
  vec4 color;   // linear; w: width in pixels
  vec4 heights; // metres between lines
} contours;

vec3 contours_add(vec3 light, Place place) {
  float line = place.height / contours.heights.x;
  float a_pixel = fwidth(line);  // how many lines lie in a pixel: where it is many, the lines fade
  float away = abs(line - round(line)) / max(a_pixel, 1e-6);
  float share = (1.0 - smoothstep(contours.color.w * 0.5, contours.color.w * 0.5 + 1.0, away)) * (1.0 - smoothstep(0.15, 0.4, a_pixel));
  return mix(light, contours.color.rgb * max(light.r, max(light.g, light.b)), share);
}
