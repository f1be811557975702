#pragma once

#include <string>

#include "globe/geo/geojson.h"

namespace globe::search {

/// A feature that is to be indexed.
struct NewFeature {
  geo::Geometry geometry;
  std::string name;        ///< UTF-8; empty: none
  std::string properties;  ///< a JSON object as text; empty: none
};

/// A feature as it is found.
struct FoundFeature {
  std::string name;
  std::string properties;
};

}  // namespace globe::search
