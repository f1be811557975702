#include "globe/planet/tile_directions.h"

#include "globe/htm/midpoint.h"

namespace globe::planet {

TileDirections::TileDirections(const TileId& id)
    : id_(id), values_(static_cast<std::size_t>(id.cells() + 1) * static_cast<std::size_t>(id.cells() + 1)) {
  const int cells = id.cells();
  const auto value = [&](int x, int y) -> dvec3& {
    return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells + 1) +
                   static_cast<std::size_t>(x)];
  };
  for (const ivec2 corner : {ivec2{0, 0}, ivec2{cells, 0}, ivec2{0, cells}, ivec2{cells, cells}}) {
    value(corner.x, corner.y) =
        node_direction({id.d, id.level, id.first_i() + corner.x, id.first_j() + corner.y});
  }
  for (int step = cells / 2; step > 0; step /= 2) {
    for (int y = 0; y <= cells; y += step) {
      const bool odd_row = (y / step & 1) != 0;
      for (int x = odd_row ? 0 : step; x <= cells; x += odd_row ? step : 2 * step) {
        const auto ends = halved_edge(x / step, y / step);
        value(x, y) = htm::midpoint(value(ends[0].x * step, ends[0].y * step),
                                    value(ends[1].x * step, ends[1].y * step));
      }
    }
  }
}

}  // namespace globe::planet
