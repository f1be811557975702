#include "globe/render/region_below.h"

#include "globe/clipmap/ground_below.h"

namespace globe::render {

double height_above_ground(const clipmap::Settings& settings, const planet::Surface& surface,
                           const glm::dvec3& position, int max_level, bool wait, const RegionBelow& region) {
  double above = region.share > 0.0 ? region.share * region.above_m : 0.0;
  if (region.share < 1.0)
    above +=
        (1.0 - region.share) * clipmap::height_above_ground(settings, surface, position, max_level, wait);
  return above;
}

}  // namespace globe::render
