#pragma once

#include "converters/footprint.h"
#include "converters/source_map.h"

namespace converters {

/// Values at a place of a window, x counted as the window's columns are. Each returns false, and leaves `out`
/// alone, when there is nothing valid in its reach. The window holds every sample in reach.
bool nearest(const Window& window, int channels, const SamplePlace& place, float* out);
bool bilinear(const Window& window, int channels, const SamplePlace& place, float* out);
bool bicubic(const Window& window, int channels, const SamplePlace& place, float* out);

/// Mean over a footprint, whose columns count from place.x.whole: every point of the map weighs as its area
/// on the sphere of normals. Integrated exactly along rows, by the middle rule across them.
bool footprint_mean(const Window& window, int channels, const MapGeometry& geometry,
                    const Footprint& footprint, const SamplePlace& place, float* out);

/// Mean of everything on the pole's side of a row coordinate.
bool cap_mean(const SourceMap& map, double rim, bool north, float* out);

/// Mean of a whole row.
bool row_mean(const SourceMap& map, int y, float* out);

}  // namespace converters
