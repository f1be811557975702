#pragma once

#include <functional>
#include <iosfwd>
#include <vector>

#include "converters/buffer.h"
#include "converters/map_geometry.h"

namespace converters {

/// Values for the voids of a map, made from the valid samples around them: averages over ever larger blocks,
/// the smallest block that holds anything valid wins, interpolated bilinearly. Every value is a mean of valid
/// samples with positive weights, so it stays within their range.
///
/// Blocks are single samples up to 4096 columns; larger maps start from means over blocks of them.
class VoidFill {
 public:
  VoidFill(const MapGeometry& geometry, int channels);

  /// Adds one valid sample of the map.
  void add(int x, int y, const float* value);

  /// Closes the gaps, after the last add, and keeps what came of it within the budget. At least one sample
  /// must have come.
  void finish(MemoryBudget& budget);

  void value(const SamplePlace& place, float* out) const;

  /// A finished fill as bytes, to be loaded into a new one of the same map. The stream fails when it ends
  /// early.
  void save(std::ostream& stream) const;
  void load(std::istream& stream, MemoryBudget& budget);

 private:
  struct Grid {
    int width, height;
    std::vector<float> values;  ///< channels, then weight, for each block

    float* at(int x, int y, int stride);
    const float* at(int x, int y, int stride) const;
  };
  /// Values of blocks, channels beside one another, that lie somewhere.
  struct Blocks {
    int width, height, stride;
    const float* values;

    const float* at(int x, int y) const {
      return values +
             (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                 static_cast<std::size_t>(stride);
    }
  };
  Blocks blocks_of(const Grid& grid) const { return {grid.width, grid.height, stride_, grid.values.data()}; }
  Grid coarser(const Grid& fine) const;
  void fill_from(const Grid& coarse, Grid& fine) const;
  void interpolate(const Blocks& grid, double x, double y, float* out) const;

  int channels_;
  int stride_;
  int factor_;
  bool wraps_;     ///< columns go all around
  Grid grid_;      ///< until it is finished
  Buffer filled_;  ///< then: the same without weights
};

}  // namespace converters
