#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "globe/htm/region.h"
#include "globe/planet/surface.h"

namespace globe::planet {

/// A height and where it is.
struct HeightAt {
  double height_m = 0;
  dvec3 at{0.0};  ///< geodetic normal
};

/// The ground of a region at a level.
///
/// 1. `samples` counts the nodes of the level in the region, by Region::contains, each once; `lowest` and
///    `highest` are of these nodes, exactly. Of equal ones it is the first in the order of the grid: north
///    pole, then diamond by diamond along a Z curve of its cells, south pole.
/// 2. `mean_m` is the mean of the surface that is linear in each trixel of the level, over the region,
/// weighted
///    by true area on the ellipsoid. So it may lie outside of what few nodes range over.
/// 3. `area_m2` is the region's own, whatever the level: trixels on the border are cut until they are small,
///    then along the straight line between where the border crosses two of their sides.
/// 4. A region without a node has 0 samples; lowest and highest are then those of the linear surface, at the
///    corners inside of the trixels that point 3 makes; or, where the region is smaller than the trixels of
///    level 28 (4 cm on the Earth), at the centre of one that it touches.
///
/// Error of the area, seen: none for regions whose border runs along trixels; 1e-5 of it for smooth borders,
/// 2e-4 for polygons and boxes, also long thin ones (tests/hard/summary_test.cpp). Of the mean: 2e-5 of the
/// range of heights, and what the area's error adds.
struct RegionSummary {
  int level = 0;  ///< the finest that nodes were taken of
  std::uint64_t samples = 0;
  HeightAt lowest, highest;
  double mean_m = 0;
  double area_m2 = 0;
};

/// Tiles of synthesised ground that a summary makes at most: the whole planet at level 11.
inline constexpr std::uint64_t kSummaryTiles = 4096;

/// What a region holds; nothing for an empty one.
///
/// Of a planet on disk at its own level, the pyramids "height_range" and "height_mean" answer for what lies
/// inside; nodes are looked at along the border and where the extremes are. So the work grows with the
/// border, not with the area. At coarser levels, and of planets without these layers, all nodes are read.
/// Finer than the data, and of the built-in planet, all nodes are made (about 0.4 µs each).
///
/// By the data: the nodes and the linear surface are those of the finest data everywhere, of the level of the
/// insets' in those of the planet's own trixels that an inset touches, else of the planet's own; nothing is
/// synthesised.
/// @param level  0..htm::kMaxLevel; none: by the data (the built-in planet: its own level)
/// Throws globe::Error when more than kSummaryTiles tiles would have to be made.
std::optional<RegionSummary> summarize(const Surface& surface, const htm::Region& region,
                                       std::optional<int> level);

}  // namespace globe::planet
