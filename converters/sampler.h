#pragma once

#include <functional>

#include "converters/map_stack.h"
#include "converters/node_rect.h"

namespace converters {

/// Takes nodes i .. i+count-1 of row j of the rectangle's diamond: their values, channels interleaved, and of
/// each the share of its filter's weights that fell on valid samples, 0 to 1. Called from several threads,
/// once for each node.
using RowSink = std::function<void(int i, int j, int count, const float* values, const float* weights)>;

/// Gives the values of every node of a rectangle to a sink.
using NodeSource = std::function<void(const NodeRect& rect, const RowSink& sink)>;

/// What nodes get that nothing valid is in reach of (weight 0).
enum class Gaps {
  kZero,  ///< 0
  kFill   ///< on a map: its SourceMap::fill, of the uppermost map there; beside all maps 0
};

/// Values of the maps at every node of a rectangle, on the threads of the calling arena. `progress` hears of
/// the share done.
///
/// Each node is sampled at its own latitude and longitude in each map's own frame, and its value depends on
/// the vertex alone: nodes that diamonds or rectangles share get equal bits, whatever the number of threads.
///
/// - nearest: the sample whose area holds the node.
/// - bilinear, bicubic (Catmull-Rom, kept within the range of its 4x4 samples): across longitude 180 and the
///   poles too. A pole that a map reaches all around is the mean of its row.
/// - area: mean of the map, joined bilinearly, over the node's footprint (footprint.h).
///
/// Voids, and places off the map, take no part: the rest of the weights is scaled up. Where part of a map's
/// weights is missing, the maps below make up for it: maps of one lattice that adjoin are joined without a
/// seam, and a map ends in another one within a sample.
void sample_nodes(const MapStack& maps, const NodeRect& rect, Gaps gaps, const RowSink& sink,
                  const std::function<void(double)>& progress);

/// The same into arrays: values[(j * ni + i) * channels + c] and weights[j * ni + i], counted from i0 and j0.
void sample_rect(const MapStack& maps, const NodeRect& rect, Gaps gaps, float* values, float* weights);

}  // namespace converters
