// Functions of the clipmap's vertices, plain GLSL of plain arguments: the tests compile this file as C++ too.

// Distance of a node from one image of the nadir along the shortest lattice path, in 1/1024 cells. Integers: both sides of a
// seam between diamonds, where the lattice is turned, get the same.
int hex_length(ivec2 offset) {
  ivec2 a = abs(offset);
  return max(max(a.x, a.y), abs(offset.x + offset.y));
}

// Morph factor at a distance: 0 fine, 1 coarse (globe/clipmap/morph.h).
float morph_factor(int distance, int begin, int end) {
  return clamp(float(distance - begin) / float(end - begin), 0.0f, 1.0f);
}

// Share of the coarser level's shading at a morph factor: turned over in a quarter of the band, so that few pixels need both.
float shading_share(float alpha) { return clamp(4.0f * alpha - 2.0f, 0.0f, 1.0f); }

// Exact at both ends, which mix() is not on every driver.
float exact_mix(float a, float b, float t) { return t >= 1.0f ? b : (t <= 0.0f ? a : a + (b - a) * t); }

// Texel of a toroidal window: `node` counts from the window's first node, `origin` is that node's texel.
ivec2 torus_texel(ivec2 node, ivec2 origin, int size) {
  ivec2 texel = node + origin;
  return ivec2(texel.x >= size ? texel.x - size : texel.x, texel.y >= size ? texel.y - size : texel.y);
}

// The same where wraps are laid like bricks (globe/clipmap/torus.h); `brick`: width, height and shift of the torus. A window is
// lower than two of them, and narrower than one.
ivec2 brick_texel(ivec2 node, ivec2 origin, ivec3 brick) {
  ivec2 texel = node + origin;
  int wraps = (texel.y >= brick.y ? 1 : 0) + (texel.y >= 2 * brick.y ? 1 : 0);
  texel = ivec2(texel.x - wraps * brick.z, texel.y - wraps * brick.y);
  int aside = texel.x < 0 ? brick.x : (texel.x >= brick.x ? -brick.x : 0);
  return ivec2(texel.x + aside, texel.y);
}
