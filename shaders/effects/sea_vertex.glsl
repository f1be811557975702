// The sea over a vertex of its floor, for clipmap.vert.
#include "effects/sea_block.glsl"

// Height of the waves at sea level.
float wave_height(vec3 relative_m, float depth) {
  vec3 offset = sea_offset(relative_m);
  float level_2 = level_part_2(offset);
  float away = length(relative_m);
  float height = 0.0;
  for (int k = 0; k < int(sea.level.x); ++k) {
    float share = mesh_share(away, 6.2831853 / sea.along[k].w);
    if (share <= 0.0) break;
    float way = wave_way(offset, level_2, sea.along[k].xyz, sea.form[k].z, sea.level.y);
    height += share * sea.form[k].x * cos(sea.along[k].w * way + sea.form[k].y);
  }
  return height * shoal_share(depth, sea.level.z);
}

// `floor_m`: from the eye; `height` of it.
vec3 sea_over(vec3 floor_m, float height) {
  precise vec3 up = normalize((view.eye_km.xyz + floor_m * 1e-3 * view.rounding.xxy) * view.rounding.xxy);
  precise vec3 level = floor_m - height * up;
  precise float waves = wave_height(level, -height);
  precise vec3 place = level + waves * up;
  return place;
}
