// A label as a rectangle of pixels (globe/effects/labels.cpp).
layout(location = 0) in vec4 place;   // pixels: left, top, width, height
layout(location = 1) in vec4 source;  // texels: left, top, width, height
layout(location = 2) in float share;
layout(location = 0) uniform vec2 picture;  // width and height

out vec2 texel;
flat out float shown;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 pixel = place.xy + corner * place.zw;
  texel = source.xy + corner * source.zw;
  shown = share;
  gl_Position = vec4(pixel.x / picture.x * 2.0 - 1.0, 1.0 - pixel.y / picture.y * 2.0, 0.0, 1.0);
}
