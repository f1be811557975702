#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "globe/clipmap/culling.h"
#include "globe/geo/ellipsoid.h"

namespace globe::effects {

/// A corner of a line on a map: degrees, the longitude not folded.
struct MapCorner {
  double lat_deg = 0, lon_deg = 0;
};

/// A short piece of a line on the ground, as shaders/effects/shapes_line.vert takes it: the part of a plane
/// that stands upright on two places, between the heights that the ground has there. Metres from the eye; a
/// point is a piece of no length.
struct Arc {
  glm::vec4 a;       ///< a place of middle height; w: from there down to the lowest, at most 0
  glm::vec4 b;       ///< the other end; w: up to the highest
  glm::vec4 up_a;    ///< vertical there, unit; w: half the line's width in pixels
  glm::vec4 up_b;    ///< w: length
  glm::vec4 across;  ///< normal of the plane, unit; w: its distance from the eye
  glm::vec4 along;   ///< unit, from a to b; w: of a, from the eye
};

/// What lines are cut to arcs for.
struct LineView {
  const geo::Ellipsoid& ellipsoid;
  glm::dvec3 eye;  ///< ECEF metres
  const clipmap::Frustum& frustum;
  const clipmap::Horizon& horizon;
  double pixel;                ///< at distance 1, in the middle of the picture
  double tolerance_px;         ///< that an arc may be off the line
  double ground_m;             ///< height of the ground under the eye above the ellipsoid
  double above_m;              ///< of the eye above it, > 0
  double lowest_m, highest_m;  ///< of all ground
  /// Lowest and highest that the ground may be within so many metres of a place with this normal, seen from
  /// a distance.
  std::function<glm::dvec2(const glm::dvec3& u, double within_m, double distance_m)> ground;
};

/// A line whose edges are straight in latitude and longitude (RFC 7946, 3.1.1), cut to arcs for a view: as
/// few as its tolerance allows, none out of view or behind the horizon. @approximation marks.lines
///
/// Its corners form a binary tree; a node knows how far its corners and edges are off the arc between its
/// ends, so a frame takes time by what is in view of it, not by its corners. Long edges are halved until
/// each part is straight enough, by the bound of the second derivative that region::MapLine has too.
class ShapeLine {
 public:
  /// REQUIRES: two corners or more; one: a point.
  /// @param half_width_px  of its arcs
  ShapeLine(const geo::Ellipsoid& ellipsoid, std::vector<MapCorner> corners, float half_width_px);

  /// False only when nothing of it is in view. Quick.
  bool may_be_seen(const LineView& view) const;
  void add_arcs(const LineView& view, std::vector<Arc>& arcs) const;

  std::size_t corners() const { return corners_.size(); }

 private:
  struct Place {
    glm::dvec3 u, at;  ///< normal; its place on the ellipsoid, ECEF metres
  };
  struct Sphere {
    glm::dvec3 centre{0.0};
    double radius = 0;
  };
  struct Node {
    std::uint32_t first = 0, last = 0;  ///< corners
    std::uint32_t left = 0, right = 0;  ///< nodes; 0: one edge
    Sphere around;                      ///< of its places on the ellipsoid
    double error_m = 0;                 ///< of the arc from its first corner to its last
  };
  /// A part of an edge, between two shares of it.
  struct Part {
    double t0, t1;
    Place a, b;
  };

  Place place_of(double lat_deg, double lon_deg) const;
  glm::dvec3 vertical_of(const Node& node) const;
  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  double error_of(const Node& node) const;
  /// Bounds of the length of a part of an edge, and of how far it is off the arc between its ends, metres.
  double length_of(std::uint32_t edge, double t0, double t1) const;
  double bend_of(std::uint32_t edge, double t0, double t1) const;
  bool may_be_seen(const Node& node, const LineView& view) const;
  void visit(std::uint32_t node, const LineView& view, std::vector<Arc>& arcs) const;
  void visit_edge(std::uint32_t edge, const Part& part, int depth, const LineView& view,
                  std::vector<Arc>& arcs) const;
  void add_arc(const Place& a, const Place& b, double distance_m, const LineView& view,
               std::vector<Arc>& arcs) const;

  geo::Ellipsoid ellipsoid_;
  std::vector<MapCorner> corners_;
  std::vector<Place> places_;
  std::vector<double> bends_;  ///< of whole edges
  std::vector<Node> nodes_;
  float half_width_px_;
};

}  // namespace globe::effects
