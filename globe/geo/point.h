#pragma once

#include <string_view>

#include "globe/geo/ellipsoid.h"

namespace globe::geo {

/// A place as people write it.
struct Point {
  Geodetic position;     ///< latitude in [-90, 90], longitude folded to [-180, 180), h in metres or 0
  bool has_alt = false;  ///< whether an ALT was given
};

/// Reads `LAT LON [ALT]` or `LAT,LON[,ALT]` (plain numbers or degrees, minutes, seconds with N, S, E, W, also
/// apart: `10.5 N 20 E`), UTM or UPS (`33N 500000 4000000`) or MGRS, with or without spaces (`33T WN 80000
/// 90000`; the square's centre).
///
/// Latitude first, unless the letters say otherwise. Plain numbers are read by from_chars before anything
/// else: GeographicLib's GeoCoords would take the e of `1e-7` for east. Where `33N 10 500` could be a
/// latitude or a zone it is a zone, as in GeoCoords. Throws globe::UsageError: no point, |latitude| > 90, not
/// finite.
Point parse_point(std::string_view text);

/// Metres of a length with or without a unit: m (also without), km, ft, mi, nmi. Throws globe::UsageError.
double parse_length_m(std::string_view text);

}  // namespace globe::geo
