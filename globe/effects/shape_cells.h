#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "globe/effects/shape_lines.h"

namespace globe::effects {

/// Which places of a map lie in any of some polygons, as a table that a shader asks for each pixel.
///
/// The map is a square of 360 degrees from longitude -180 and latitude -90 on, cut into 8x8 cells, which are
/// cut again while many edges run through them. A cell knows how often polygons wind around one place in it;
/// for another place the edges are counted that the way there crosses. What an odd number of a polygon's
/// rings surround is inside; several polygons are united, as in region::MapPolygon. Longitudes count modulo
/// 360.
class ShapeCells {
 public:
  using Ring = std::vector<MapCorner>;  ///< the last corner leads back to the first
  using Rings = std::vector<Ring>;

  explicit ShapeCells(std::span<const Rings> polygons);

  /// Tables of 64 cells, row by row from the south-west; the first is the whole map's. A cell is two words:
  ///     0, winding                              no edge runs through it
  ///     1 | table << 2, unused                  it is cut again
  ///     2 | first edge << 2, edges | place << 16 | (winding + 2048) << 20
  /// `place`: which of kPlaces the winding is known of.
  const std::vector<glm::uvec2>& cells() const { return cells_; }
  /// Edges in degrees: from (x, y), to (x, y); those of a cell one after the other.
  const std::vector<glm::dvec4>& edges() const { return edges_; }

  /// As the shader answers. @param lat_deg  in [-90, 90]  @param lon_deg  any, finite
  bool contains(double lat_deg, double lon_deg) const;

  /// In a cell, of its side.
  static constexpr glm::dvec2 kPlaces[4] = {
      {0.48828125, 0.36328125}, {0.23046875, 0.71484375}, {0.83203125, 0.55078125}, {0.61328125, 0.12890625}};

 private:
  struct Cell {
    double x, y, side;  ///< degrees
    int depth;
  };
  /// A place off all edges, and the winding there.
  struct Known {
    glm::dvec2 at;
    int winding;
  };

  void add_edges(const Rings& polygon);
  std::uint32_t build(const Cell& cell, const std::vector<std::uint32_t>& edges, const Known& known);
  int winding_at(const glm::dvec2& at, const std::vector<std::uint32_t>& edges, const Known& known) const;

  std::vector<glm::dvec4> all_;  ///< every edge once, while the table is made
  std::vector<glm::uvec2> cells_;
  std::vector<glm::dvec4> edges_;
};

}  // namespace globe::effects
