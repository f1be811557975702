#pragma once

#include <functional>

#include "converters/node_rect.h"
#include "converters/source_map.h"

namespace converters {

enum class Filter { kNearest, kBilinear, kBicubic, kArea };

/// Takes the values of nodes i .. i+count-1 of row j of the rectangle's diamond. Called from several threads,
/// once for each node but a pole, which comes once more.
using RowSink = std::function<void(int i, int j, int count, const float* values)>;

/// Gives the values of every node of a rectangle to a sink.
using NodeSource = std::function<void(const NodeRect& rect, const RowSink& sink)>;

/// Value of the map at every node of a rectangle, on the threads of the calling arena.
///
/// Each node is sampled at its own latitude and longitude, and its value depends on the vertex alone: nodes
/// that diamonds or rectangles share get equal bits, whatever the number of threads.
///
/// - nearest: the sample whose area holds the node.
/// - bilinear, bicubic (Catmull-Rom, kept within the range of its 4x4 samples): across longitude 180 and the
/// poles
///   too. A pole is the mean of its row.
/// - area: mean of the map, joined bilinearly, over the node's footprint (footprint.h).
///
/// Voids take no part: the rest of the weights is scaled up; where nothing valid is left, SourceMap::fill.
void sample_nodes(const SourceMap& map, Filter filter, const NodeRect& rect, const RowSink& sink,
                  const std::function<void(double)>& progress);

}  // namespace converters
