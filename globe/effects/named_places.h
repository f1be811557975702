#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "globe/geo/geojson.h"

namespace globe::effects {

/// A name on a planet and where it is written.
struct NamedPlace {
  enum class Kind { kPoint, kLine, kArea };

  std::string name;  ///< one line of UTF-8, not empty
  Kind kind = Kind::kPoint;
  double lat_deg = 0, lon_deg = 0;  ///< of a point, half way along a line, well inside an area
  double size_deg = 0;              ///< of what it names, along a great circle; points: 0
  double priority = 0;              ///< the higher, the more it matters
};

/// The names of a GeoJSON file's features that have some, those that matter most first, else in the file's
/// order. A feature's name is written once: at its largest polygon, else its longest line, else each point.
///
/// @param property  that holds the name; empty: "name", "NAME", "Name", "label", "title", the first there is
/// @param priority  a numeric property, the higher the more; empty: the first there is of priority,
/// population, pop_max, elevation, ele, or of scalerank and rank, the lower the more. Features without come
/// last
/// Throws what geo::visit_geojson throws.
std::vector<NamedPlace> read_named_places(const std::filesystem::path& file, const std::string& property,
                                          const std::string& priority);

/// A place inside a polygon, far from its border where that is easily found. Latitude and longitude count as
/// on a map.
geo::Geodetic place_inside(const geo::Geometry::Rings& polygon);

}  // namespace globe::effects
