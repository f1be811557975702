// What every pass of a frame knows of the view. Mirrored by render::ViewBlock.
layout(std140, binding = 0) uniform View {
  mat4 clip_from_relative;  // camera-relative metres to clip space, reversed infinite depth
  vec4 eye_km;              // camera from the planet's centre in round space; w: the ground's radius there
  vec4 sun;                 // unit, toward the sun; w: sunlight
  vec4 rounding;            // x, y: factors along x, y and along z that make the ellipsoid round; z: 1 when there is air; w: exposure
  vec4 right;               // picture axes in world space, scaled to the view's half width
  vec4 up;                  // and half height at distance 1
  vec4 forward;
  vec4 sun_at_eye;          // share of sunlight that reaches the eye
} view;
