#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "globe/htm/border.h"
#include "globe/htm/region.h"
#include "globe/region/map_line.h"

namespace globe::region {

/// Polygons whose edges are straight in latitude and longitude, as RFC 7946 has them.
///
/// They are plane polygons on a map that goes on without end to the east and west: an edge from 170 to -170
/// runs through Greenwich, one from 170 to 190 across the antimeridian. What an odd number of a polygon's
/// rings surround is inside; several polygons are united. Edges and corners are inside. Where two polygons,
/// cut at the antimeridian, meet along it, it is no border, nor is a pole.
class MapPolygon final : public htm::Region {
 public:
  using Ring = std::vector<MapPoint>;  ///< the last corner leads back to the first, which may be repeated
  using Rings = std::vector<Ring>;

  /// Throws UsageError: no ring, fewer than 3 different corners, edges of one polygon that cross.
  explicit MapPolygon(std::span<const Rings> polygons);

  bool contains(const htm::dvec3& u) const override;
  htm::Relation relation(const htm::Corners& trixel) const override;
  std::vector<htm::dvec3> border_points() const override;

 private:
  struct Edge {
    MapPoint a, b;
    std::uint32_t polygon = 0, ring = 0, number = 0;
  };

  void add_ring(const Ring& ring, std::uint32_t polygon, std::uint32_t number);
  void refuse_crossings() const;
  htm::Border border() const;
  bool contains_on_map(const MapPoint& at) const;
  std::string edge_name(const Edge& edge) const;

  std::vector<Edge> edges_;
  std::size_t polygon_count_ = 0, ring_count_ = 0;
  double west_deg_ = 0, east_deg_ = 0;
  bool north_pole_ = false, south_pole_ = false;
  htm::BoxTree tree_;  ///< of the edges, on the map: x = longitude, y = latitude
  htm::Border border_;
};

}  // namespace globe::region
