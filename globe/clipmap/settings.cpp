#include "globe/clipmap/settings.h"

#include <bit>
#include <string>

#include "globe/base/error.h"

namespace globe::clipmap {

Settings Settings::for_detail(int detail, int shading_levels) {
  if (detail < 16 || detail > 1024) {
    throw UsageError("--detail " + std::to_string(detail), "the hexagon's side is 16 to 1024 cells",
                     "give a number in that range");
  }
  Settings settings;
  settings.m = static_cast<int>(std::bit_floor(static_cast<unsigned>(detail / 8)));
  const int unit = settings.unit();
  settings.s = (detail + unit - 1) / unit * unit;
  settings.base_level = static_cast<int>(std::bit_width(static_cast<unsigned>(settings.s))) - 1;
  settings.shading_levels = shading_levels;
  return settings;
}

}  // namespace globe::clipmap
