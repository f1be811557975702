// The sun mirrored in water. For vertex shaders, after lib/air_light.glsl.

// Share of the sunlight that level water sends to the eye.
float sun_glint(AirLight light) {
  vec3 half_way = normalize(view.sun.xyz - light.direction);
  return 0.22 / kSunRange * pow(max(dot(light.up, half_way), 0.0), 120.0) * step(0.0, light.cos_sun);
}
