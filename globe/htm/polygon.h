#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "globe/htm/box_tree.h"
#include "globe/htm/cone.h"
#include "globe/htm/great_circle.h"
#include "globe/htm/region.h"

namespace globe::htm {

/// Polygons whose edges are great circles: convex or not, with holes, any number of them.
///
/// 1. A ring's inside is the smaller of its two sides, whichever way it is wound; of two equal ones (to 1e-10
///    of the sphere) the one to the left.
/// 2. A polygon's inside is what an odd number of its rings have inside: an outer ring, less its holes.
/// 3. Several polygons are united; they may overlap.
/// 4. Edges and corners are inside. All decisions are by exact signs of the directions given
///    (predicates.h); `relation` says kTouches for a trixel that an edge touches, even where the polygons on
///    both sides of it hold the trixel together.
///
/// Edges lie in a tree, so that a question costs about log n.
class Polygon final : public Region {
 public:
  using Ring = std::vector<dvec3>;  ///< unit; the last corner leads back to the first, which may be repeated
  using Rings = std::vector<Ring>;

  /// One polygon of these rings. Throws UsageError: no ring, fewer than 3 different corners, opposite ends of
  /// an edge, edges of one polygon that cross (touching is allowed).
  explicit Polygon(const Rings& rings);
  explicit Polygon(std::span<const Rings> polygons);

  bool contains(const dvec3& u) const override;
  Relation relation(const Corners& trixel) const override;
  std::vector<dvec3> border_points() const override;

 private:
  struct Edge {
    GreatCircle circle;                               ///< from a to b
    std::uint32_t polygon = 0, ring = 0, number = 0;  ///< from 0; the number is that of corner a as given
  };
  /// A direction off all edges, and the polygons that hold it, in rising order.
  struct Reference {
    dvec3 at{0.0};
    std::vector<std::uint32_t> holders;
  };

  void add_ring(const Ring& ring, std::uint32_t polygon, std::uint32_t number);
  void refuse_crossings() const;
  void find_references();
  void find_surroundings();
  bool on_an_edge(const dvec3& u) const;
  /// Asks `visit` of each edge that the arc from p to u crosses. REQUIRES: both on no edge, not opposite.
  template <typename Visit>
  void visit_crossed(const dvec3& p, const dvec3& u, const Visit& visit) const;
  /// The polygons that hold u, from those that hold the reference.
  std::vector<std::uint32_t> holders(const Reference& from, const dvec3& u) const;
  /// Whether any polygon holds u, which is on no edge.
  bool held(const dvec3& u) const;
  const Reference& nearest_reference(const dvec3& u) const;
  std::string edge_name(const Edge& edge) const;

  std::vector<Edge> edges_;
  std::size_t polygon_count_ = 0;
  std::size_t ring_count_ = 0;
  BoxTree tree_;
  std::vector<Reference> references_;
  std::optional<Cone> around_;  ///< holds all edges, if they lie in less than a half of the sphere
  bool held_beyond_ = false;    ///< what is outside `around_`
};

}  // namespace globe::htm
