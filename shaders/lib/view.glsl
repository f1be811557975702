// What every pass of a frame knows of the view. Mirrored by render::ViewBlock.
layout(std140, binding = 0) uniform View {
  mat4 clip_from_relative;  // camera-relative metres to clip space, reversed infinite depth
  vec4 eye_km;              // camera from the planet's centre; w: ground radius under it
  vec4 sun;                 // unit, toward the sun; w: sunlight
  vec4 axes_km;             // 1 / a², 1 / b² in 1/km²; z: 1 when there is air; w: exposure
  vec4 right;               // picture axes in world space, scaled to the view's half width
  vec4 up;                  // and half height at distance 1
  vec4 forward;
} view;
