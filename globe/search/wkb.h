#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "globe/geo/geojson.h"

namespace globe::search {

/// A geometry as a GeometryCollection of points, lines and polygons in well-known binary (OGC 06-103r4, 8):
/// little endian, x = longitude, y = latitude, in degrees; heights are left out, rings are closed.
std::string to_wkb(const geo::Geometry& geometry);

/// Back again; nothing for bytes that `to_wkb` does not write: cut short, too long, coordinates off the
/// planet.
std::optional<geo::Geometry> from_wkb(std::string_view bytes);

}  // namespace globe::search
