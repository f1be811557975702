#pragma once

#include <optional>
#include <vector>

#include "globe/geo/geojson.h"
#include "globe/htm/polygon.h"
#include "globe/htm/region.h"
#include "globe/search/nearest_place.h"

namespace globe::search {

/// Points, lines and polygons of one feature, on the sphere of normals.
///
/// Edges are great circles of normals, as HTM's and those of htm::Polygon are, whose rules hold for polygons:
/// the smaller side of a ring is inside, edges are part of it, several polygons are united.
class Shape {
 public:
  /// REQUIRES: not empty. Throws UsageError: a polygon with fewer than 3 different corners in a ring, edges
  /// of one polygon that cross, an edge that joins opposite points.
  explicit Shape(const geo::Geometry& geometry);

  /// Its first point, or the first vertex of its lines and polygons.
  const geo::Geodetic& any_place() const { return points_.empty() ? lines_[0][0].at : points_[0].at; }

  /// Whether any place of the shape is in the region (region_touch.h says how near counts).
  bool touches(const htm::Region& region) const;

  /// The place of the shape that is nearest to another: that place itself inside a polygon.
  Nearest nearest(const GeographicLib::Geodesic& earth, const geo::Geodetic& from) const;

  /// Trixels that together hold the shape: kCover of them or fewer for lines and polygons, as fine as that
  /// allows, and one of level kIndexLevel for each point.
  std::vector<htm::Trixel> cover() const;

  static constexpr std::size_t kCover = 64;

 private:
  struct Vertex {
    geo::Geodetic at;
    htm::dvec3 u;
  };
  using Line = std::vector<Vertex>;
  class Outline;

  static Line line_of(const geo::Geometry::Line& places);

  std::vector<Vertex> points_;
  std::vector<Line> lines_;  ///< and the rings of polygons, closed
  std::optional<htm::Polygon> polygons_;
};

}  // namespace globe::search
