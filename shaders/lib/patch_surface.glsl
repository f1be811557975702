// The surface of a patch between its knots, plain GLSL of plain arguments: compiled as C++ too
// (globe/clipmap/patch_surface.cpp). Corners are knots; edge k lies opposite to corner k.
//
// On an edge every sum has two terms that are not zero, and two patches that share it add the same two: they agree bit for bit
// however they are turned.

// Shares of the corners at a vertex (a, b) of a patch of m cells; exact, m being a power of two.
vec3 corner_shares(ivec2 ab, int m) {
  vec2 t = vec2(ab) / float(m);
  return vec3(1.0f - t.x - t.y, t.x, t.y);
}

vec3 between_corners(vec3 share, vec3 c0, vec3 c1, vec3 c2) {
  precise vec3 sum = (share.x * c0 + share.y * c1) + share.z * c2;
  return sum;
}

// How far the surface stands out from the flat triangle, `out_k` being how far it does in the middle of edge k: the second-order
// polynomial through the six.
vec3 bulge(vec3 share, vec3 out_0, vec3 out_1, vec3 out_2) {
  precise vec3 sum =
      4.0f * (((share.y * share.z) * out_0 + (share.z * share.x) * out_1) + (share.x * share.y) * out_2);
  return sum;
}

// The vertex at a height over the surface.
vec3 raised(vec3 surface, vec3 normal, float height) {
  precise vec3 sum = surface + height * normal;
  return sum;
}
