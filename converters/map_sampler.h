#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <functional>
#include <memory>

#include "converters/map_window.h"
#include "converters/node_values.h"

namespace converters {

/// How a pixel of a map comes from the nodes of a level.
enum class Sampling {
  kNearest,  ///< the nearest corner of the trixel that holds the pixel's centre
  kLinear,   ///< linear in that trixel
  kCubic,    ///< Catmull and Rom's spline over 4 x 4 nodes, kept within their range (planet/lattice_spline.h)
  kArea,     ///< mean of the linear surface over the pixel, by area on the sphere of normals
};

/// Turns node values into pixels. Safe to use from any thread; a pixel depends on the nodes alone, not on
/// what was sampled before.
///
/// `area` takes the mean of evenly spaced places in the pixel, no farther apart than the cells of the level
/// (one place, the centre, where pixels are no larger than cells).
class MapSampler {
 public:
  MapSampler(const NodeValues& values, Sampling sampling, const MapWindow& window);
  ~MapSampler();

  /// Pixels x0 .. x0+nx-1 of rows y0 .. y0+ny-1: out[((y - y0) * nx + (x - x0)) * channels + c].
  /// Throws globe::Error when the planet cannot be read.
  void sample(int x0, int y0, int nx, int ny, float* out) const;

 private:
  class Blocks;

  void sample_row(int x0, int y, int nx, Blocks& blocks, float* out) const;

  const NodeValues& values_;
  Sampling sampling_;
  MapWindow window_;
  int block_side_;
  int places_down_;  ///< in a pixel
  mutable tbb::enumerable_thread_specific<std::unique_ptr<Blocks>> blocks_;
};

}  // namespace converters
