#pragma once

#include "converters/footprint.h"
#include "converters/source_map.h"

namespace converters {

/// Values at a place of a window, x counted as the window's columns are. Each returns the share of its
/// weights that fell on valid samples, 0 to 1; at 0, when there is nothing valid in its reach, it leaves
/// `out` alone. The window holds every sample in reach.
double nearest(const Window& window, int channels, const SamplePlace& place, float* out);
double bilinear(const Window& window, int channels, const SamplePlace& place, float* out);
double bicubic(const Window& window, int channels, const SamplePlace& place, float* out);

/// Mean over a footprint, whose columns count from place.x.whole: every point of the map weighs as its area
/// on the sphere of normals (with a projection: in the raster). Integrated exactly along rows, by the middle
/// rule across them. The window holds every sample in reach that lies on the map.
double footprint_mean(const Window& window, int channels, const MapGeometry& geometry,
                      const Footprint& footprint, const SamplePlace& place, float* out);

/// Mean of everything on the pole's side of a row coordinate, on a map that reaches the pole all around.
double cap_mean(const SourceMap& map, double rim, bool north, float* out);

/// Mean of a whole row of a map that goes all around.
double row_mean(const SourceMap& map, int y, float* out);

}  // namespace converters
