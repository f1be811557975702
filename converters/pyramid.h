#pragma once

#include <cstdint>

#include "converters/node_grid.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

/// The next coarser level, every second sample: a coarse sample is a fine sample.
void subsample(const NodeGrid<float>& fine, NodeGrid<float>& coarse);

/// The next coarser level, filtered: 1/4 of the node itself, 1/8 of each of its six neighbours, which is the
/// hat function of the coarse lattice; at the six octahedron corners 1/3 and 1/6 of each of four. Nodes that
/// diamonds share get equal bits.
void filter(const NodeGrid<float>& fine, NodeGrid<float>& coarse);

/// Lowest and highest of the four cells of the finer level in each cell. Nodes i = n or j = n, which are no
/// cell's first corner, repeat the last cell.
void range_of_ranges(const NodeGrid<float>& fine, NodeGrid<float>& coarse);

/// Mean height of the two trixels of each cell, from those of the finer level, weighted by area
/// (planet/mean_height.h). Nodes i = n or j = n repeat the last cell.
void mean_of_means(const NodeGrid<float>& fine, const globe::geo::Ellipsoid& ellipsoid,
                   NodeGrid<float>& coarse);

/// sRGB bytes of linear light.
void encode_colors(const NodeGrid<float>& linear, NodeGrid<std::uint8_t>& bytes);

/// A mark, 0 or 1, as a layer stores it.
inline std::uint8_t mark_byte(float mark) { return mark > 0.5F ? 255 : 0; }
void encode_marks(const NodeGrid<float>& marks, NodeGrid<std::uint8_t>& bytes);

struct Range {
  double min, max;
};

}  // namespace converters
