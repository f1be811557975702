#pragma once

#include <memory>
#include <string>

#include "converters/buffer.h"
#include "converters/node_rect.h"
#include "converters/raster_projection.h"

namespace converters {

/// Heights of a geoid above the ellipsoid: what turns heights above sea level into heights above the
/// ellipsoid.
class Geoid {
 public:
  virtual ~Geoid() = default;

  /// Adds the geoid's height at each node to heights[j * ni + i], counted from the rectangle's i0 and j0.
  /// What a node gets depends on its vertex alone. Any thread may ask.
  virtual void add(const NodeRect& rect, float* heights) const = 0;
};

/// A grid of geoid heights: a raster that GDAL reads and that lies all over the planet (heights in metres, or
/// in the unit, scale and offset the file states; bicubic), or a geoid of GeographicLib, by the path of its
/// .pgm file or, installed, by its name, as egm96-5 (cubic; held in memory beside the budget). Throws
/// globe::Error when it is neither or does not cover the planet.
std::unique_ptr<const Geoid> open_geoid(const std::string& grid, const PlanetFrame& frame,
                                        MemoryBudget& budget);

}  // namespace converters
