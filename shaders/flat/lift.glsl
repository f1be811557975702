// How far a region's vertices are lifted toward the ground around it, plain GLSL of plain arguments; flat/rim.cpp compiles this file as
// C++ too, without `precise`.

// Share of the lift `away` posts from a border; 0 from `band` on.
float lift_share(float away, float band) {
  float t = min(away / band, 1.0f);
  return 1.0f - t * t * (3.0f - 2.0f * t);
}

// Lift of a vertex from those of the posts beside it at the nearest borders: across (`beside`), along (`below`), and at the corner.
float lift_of(float beside, float below, float corner, float share_x, float share_y) {
  precise float lift = share_x * beside + share_y * below - share_x * share_y * corner;
  return lift;
}
