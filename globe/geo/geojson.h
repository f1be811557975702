#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <istream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"

namespace globe::geo {

/// The places of a GeoJSON geometry (RFC 7946), whatever its type: a Point is one point, a MultiLineString
/// several lines, a GeometryCollection the sum of its members.
///
/// Latitudes are in [-90, 90]; longitudes as written, finite, not folded: an edge from 170 to 190 differs
/// from one from 170 to -170. The third number of a position is its height in metres, else 0. The last point
/// of a ring, equal to the first in the file, is left out.
struct Geometry {
  using Line = std::vector<Geodetic>;
  using Rings = std::vector<Line>;  ///< the outer one, then its holes

  std::vector<Geodetic> points;
  std::vector<Line> lines;
  std::vector<Rings> polygons;

  bool empty() const { return points.empty() && lines.empty() && polygons.empty(); }
};

/// One feature, or a geometry that stands alone.
struct Feature {
  Geometry geometry;          ///< empty when the file has null there
  nlohmann::json id;          ///< string, number or null
  nlohmann::json properties;  ///< an object or null
  std::size_t number = 0;     ///< from 1, in the order of the file
};

/// Reads a FeatureCollection, a Feature or a geometry, feature by feature, in memory for one of them.
///
/// @param name  of the file, for messages
/// @param refuse  if given, takes what is wrong with a feature, and reading goes on; else it is thrown
/// Throws Error, which names the file and the feature, for what is no JSON, no GeoJSON, a latitude beyond 90
/// degrees, a number out of range, a line of one point, a ring of fewer than four or not closed.
void visit_geojson(std::istream& stream, const std::string& name, const std::function<void(Feature&&)>& visit,
                   const std::function<void(const Error&)>& refuse = {});

/// The same from a file. Throws Error when it cannot be read.
void visit_geojson(const std::filesystem::path& path, const std::function<void(Feature&&)>& visit,
                   const std::function<void(const Error&)>& refuse = {});

}  // namespace globe::geo
