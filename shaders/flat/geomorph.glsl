// Geomorphing by nine factors (Wagner 2003), plain GLSL of plain arguments: flat/patch_mesh.cpp compiles this file as C++ too, without
// `precise`.

// Height of a vertex. `self`: share of the patch's way to the next coarser level; `sides`: those of its sides, west, east, south,
// north. What does not move a vertex is exactly 0, so that two patches compute a vertex of the side they share from equal terms.
float geomorph(float z, float self_move, vec4 side_moves, vec4 both_moves, float self, vec4 sides) {
  precise vec4 both = (vec4(1.0f) - sides) * self;
  precise vec4 moved = sides * side_moves + both * both_moves;
  precise float morphed = z + (self * self_move + ((moved.x + moved.y) + (moved.z + moved.w)));
  return morphed;
}
