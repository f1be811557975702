#pragma once

#include "globe/geo/ellipsoid.h"
#include "globe/planet/surface.h"

namespace globe::planet {

/// A place to fly to and which way to look there.
struct ScenicView {
  geo::Geodetic place;     ///< h_m: height of the ground
  double heading_deg = 0;  ///< clockwise from north
};

/// A view of high mountains, the same for the same planet; takes under a second.
///
/// Looks for the highest range of the middle latitudes, by the sea where there is one, and in it for a place
/// 12 to 36 km from the range's summit, gentle, low and open towards it, from which the sun stands to the
/// side or behind at ten in the morning, solar time.
ScenicView scenic_place(const Surface& surface);

}  // namespace globe::planet
