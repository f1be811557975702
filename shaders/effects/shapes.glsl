// What lies inside polygons (globe/effects/shapes.cpp, effects::ShapeCells).
#include "lib/map_place.glsl"
#include "lib/marked_light.glsl"

layout(std140, binding = SHAPES_BLOCK) uniform Shapes {
  MapEye eye;
  vec4 color[8];  // of the layers, as the screen shows it; w: opacity
  ivec4 table[8];  // x: the layer's first table of cells, y: where its edges begin, in words
  dvec2 eye_deg;   // longitude and latitude
  ivec4 layers;    // x: how many
} shapes;

layout(std430, binding = SHAPES_BLOCK) readonly buffer ShapeTables {
  uvec2 words[];
} shape_tables;

const dvec2 kShapePlaces[4] = dvec2[](dvec2(0.48828125LF, 0.36328125LF), dvec2(0.23046875LF, 0.71484375LF),
                                      dvec2(0.83203125LF, 0.55078125LF), dvec2(0.61328125LF, 0.12890625LF));

double shape_turn(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

int shape_crossing(dvec2 from, dvec2 to, dvec2 a, dvec2 b) {
  bool left_a = shape_turn(from, to, a) >= 0.0LF;
  bool left_b = shape_turn(from, to, b) >= 0.0LF;
  bool before = shape_turn(a, b, from) >= 0.0LF;
  bool after = shape_turn(a, b, to) >= 0.0LF;
  return left_a == left_b || before == after ? 0 : after ? 1 : -1;
}

dvec2 shape_corner(int word) { return dvec2(packDouble2x32(shape_tables.words[word]), packDouble2x32(shape_tables.words[word + 1])); }

// A layer's polygons at a place of the map, in degrees.
bool in_shape(int layer, dvec2 at) {
  dvec2 corner = dvec2(-180.0LF, -90.0LF);
  double side = 360.0LF;
  uint table = 0u;
  for (int depth = 0; depth < 10; ++depth) {
    side *= 0.125LF;
    ivec2 cell = clamp(ivec2(vec2((at - corner) / side)), ivec2(0), ivec2(7));
    corner += dvec2(cell) * side;
    uvec2 word = shape_tables.words[shapes.table[layer].x + int(table) * 64 + cell.y * 8 + cell.x];
    uint kind = word.x & 3u;
    if (kind == 0u) return int(word.y) > 0;
    table = word.x >> 2u;
    if (kind == 1u) continue;
    int winding = int(word.y >> 20u) - 2048;
    dvec2 known = corner + kShapePlaces[word.y >> 16u & 3u] * side;
    int first = shapes.table[layer].y + int(table) * 4;
    for (int k = 0; k < int(word.y & 0xffffu); ++k)
      winding += shape_crossing(known, at, shape_corner(first + 4 * k), shape_corner(first + 4 * k + 2));
    return winding > 0;
  }
  return false;
}

vec3 shapes_add(vec3 light, Place place) {
  MapPlace near = map_place(shapes.eye, place.relative);
  dvec2 at = shapes.eye_deg + dvec2(near.offset * 57.29577951);
  at.x -= 360.0LF * floor((at.x + 180.0LF) / 360.0LF);
  for (int layer = 0; layer < shapes.layers.x; ++layer) {
    if (in_shape(layer, at)) light = marked_light(light, shapes.color[layer].rgb, shapes.color[layer].w);
  }
  return light;
}
