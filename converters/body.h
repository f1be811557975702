#pragma once

#include <string>

#include "converters/raster_source.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

/// "earth", "moon" or "mars" when the ellipsoid is theirs, else "other".
std::string body_of(const globe::geo::Ellipsoid& ellipsoid);

/// The body a file seems to show by its name and description, or "".
std::string hinted_body(const RasterInfo& info);

}  // namespace converters
