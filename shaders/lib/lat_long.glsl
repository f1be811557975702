// Maps of a whole planet by latitude and longitude, 180 W and the north pole first.

// Texture coordinates of a place by its vertical.
vec2 lat_long_place(vec3 up) {
  return vec2(0.5 + 0.15915494 * atan(up.y, up.x), 0.5 - 0.31830989 * asin(clamp(up.z, -1.0, 1.0)));
}

// Mipmap level for a footprint of so many radians: not by derivatives, which leap at the date line.
float lat_long_level(sampler2D map, float footprint) {
  return max(log2(footprint * 0.31830989 * float(textureSize(map, 0).y)), 0.0);
}
