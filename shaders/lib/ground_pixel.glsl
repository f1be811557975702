// What a pixel of a patch looks up, for fragment shaders that go with clipmap.vert.
layout(binding = 2) uniform sampler2DArray lit_ground_of;
#if defined(GLINT) || defined(SEA)
layout(binding = 3) uniform sampler2DArray water_of;
#endif

in Shading {
  centroid vec3 sunlight;
  centroid vec3 skylight;
  centroid vec3 haze;
#ifdef SHADE_FINE
  vec2 texel;
#endif
#ifdef SHADE_COARSE
  vec2 coarse_texel;
#endif
#if defined(SHADE_FINE) && defined(SHADE_COARSE)
  float share;
#endif
#ifdef GLINT
  centroid float glint;
#endif
#ifdef EFFECTS
  centroid vec3 relative;
  centroid float height;
  centroid vec3 left;
#endif
#ifdef SEA
  centroid float depth;
#endif
#ifdef ROOM
  vec4 in_room;
#endif
} shading;
flat in vec3 layers;  // fine, coarse, level

// One look-up where one level is shown, two where one turns into the other.
vec4 at_pixel(sampler2DArray values) {
#if defined(SHADE_FINE) && defined(SHADE_COARSE)
  return mix(texture(values, vec3(shading.texel, layers.x)), texture(values, vec3(shading.coarse_texel, layers.y)), shading.share);
#elif defined(SHADE_COARSE)
  return texture(values, vec3(shading.coarse_texel, layers.y));
#else
  return texture(values, vec3(shading.texel, layers.x));
#endif
}
