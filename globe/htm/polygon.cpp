#include "globe/htm/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "globe/base/error.h"
#include "globe/htm/predicates.h"

namespace globe::htm {
namespace {

/// More than the rounding of a box's faces.
constexpr double kMargin = 1e-15;

constexpr const char* kHowToWrite = "give three corners or more in order along the border";

/// How far a great-circle arc between points at this squared distance rises above its chord.
double bulge(double chord2) { return 1.0 - std::sqrt(std::max(0.0, 1.0 - 0.25 * chord2)); }

double squared_distance(const dvec3& a, const dvec3& b) {
  const dvec3 d = b - a;
  return glm::dot(d, d);
}

Box arc_box(const dvec3& a, const dvec3& b) {
  const std::array<dvec3, 2> ends{a, b};
  return box_around(ends, bulge(squared_distance(a, b)) + kMargin);
}

/// -1 or 1: on which side of the great circle a corner lies; on the circle itself counts as left, as if the
/// corner had been moved there, so that no arc runs through one.
int side(const GreatCircle& circle, const dvec3& corner) { return circle.side(corner) >= 0 ? 1 : -1; }

/// Whether an arc crosses an edge. Neither end of the arc lies on the edge.
bool crosses(const GreatCircle& arc, const GreatCircle& edge) {
  const int side_a = side(arc, edge.a());
  if (side_a == side(arc, edge.b())) return false;
  return edge.side(arc.a()) == -side_a && edge.side(arc.b()) == side_a;
}

/// Whether two edges cross at a point inside both, ends excluded.
bool crosses_inside(const GreatCircle& e, const GreatCircle& f) {
  if (e.a() == f.a() || e.a() == f.b() || e.b() == f.a() || e.b() == f.b()) return false;
  const int side_a = e.side(f.a());
  if (side_a == 0 || e.side(f.b()) != -side_a) return false;
  return f.side(e.a()) == -side_a && f.side(e.b()) == side_a;
}

/// Whether u lies on an edge, exactly.
bool on_edge(const GreatCircle& edge, const dvec3& u) {
  if (u == edge.a() || u == edge.b()) return true;
  if (edge.side(u) != 0) return false;
  const double length2 = squared_distance(edge.a(), edge.b());
  return squared_distance(edge.a(), u) <= length2 && squared_distance(edge.b(), u) <= length2;
}

/// Area of the ring as seen from o, which lies on no edge: the sum over triangles o, a, b. Counts parts by
/// how often they are wound around, none for the side where -o lies.
double signed_area(std::span<const dvec3> ring, const dvec3& o) {
  double half_sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const dvec3& a = ring[k];
    const dvec3& b = ring[k + 1 == ring.size() ? 0 : k + 1];
    // Eriksson 1990: tan(E / 2) of a triangle's excess.
    half_sum +=
        std::atan2(glm::dot(o, glm::cross(a, b - a)), 1.0 + glm::dot(o, a) + glm::dot(a, b) + glm::dot(b, o));
  }
  return 2.0 * half_sum;
}

/// Whether the smaller side of the ring is the one where -o lies.
bool smaller_side_is_opposite(std::span<const dvec3> ring, const dvec3& o) {
  constexpr double kHalfSphere = 2.0 * std::numbers::pi;
  constexpr double kEqual = 1e-10;
  const double area = signed_area(ring, o);
  // -o lies to the right of the ring if the area is positive.
  if (std::abs(std::abs(area) - kHalfSphere) < kEqual) return area < 0.0;
  return std::abs(area) > kHalfSphere;
}

/// The corners of a tetrahedron, askew to the axes: every direction is within 71 degrees of one.
std::array<dvec3, 4> askew_tetrahedron(double turn) {
  std::array<dvec3, 4> result{dvec3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (dvec3& v : result) {
    for (int axis = 0; axis < 3; ++axis) {
      const double angle = 0.37 + 0.61 * axis + turn;
      const double c = std::cos(angle), s = std::sin(angle);
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      const double x = v[i], y = v[j];
      v[i] = c * x - s * y;
      v[j] = s * x + c * y;
    }
    v = glm::normalize(v);
  }
  return result;
}

/// Toggles an item of a sorted list.
void toggle(std::vector<std::uint32_t>& list, std::uint32_t item) {
  const auto at = std::lower_bound(list.begin(), list.end(), item);
  if (at != list.end() && *at == item) {
    list.erase(at);
  } else {
    list.insert(at, item);
  }
}

}  // namespace

Polygon::Polygon(const Rings& rings) : Polygon(std::span<const Rings>(&rings, 1)) {}

Polygon::Polygon(std::span<const Rings> polygons) : polygon_count_(polygons.size()), tree_({}) {
  for (std::uint32_t p = 0; p < polygons.size(); ++p) {
    ring_count_ += polygons[p].size();
    for (std::uint32_t r = 0; r < polygons[p].size(); ++r) add_ring(polygons[p][r], p, r);
  }
  if (edges_.empty()) throw UsageError("polygon", "it has no corners", kHowToWrite);
  std::vector<Box> boxes;
  boxes.reserve(edges_.size());
  for (const Edge& edge : edges_) boxes.push_back(arc_box(edge.circle.a(), edge.circle.b()));
  tree_ = BoxTree(boxes);
  refuse_crossings();
  find_references();
  find_surroundings();
}

void Polygon::add_ring(const Ring& ring, std::uint32_t polygon, std::uint32_t number) {
  std::set<std::array<double, 3>> different;
  for (std::uint32_t k = 0; k < ring.size(); ++k) {
    const dvec3& a = ring[k];
    const dvec3& b = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (different.size() < 3) different.insert({a.x, a.y, a.z});
    if (a == b) continue;
    edges_.push_back({GreatCircle(a, b), polygon, number, k});
    if (squared_distance(a, -b) < 1e-28) {
      throw UsageError("polygon", edge_name(edges_.back()) + " joins two opposite points of the sphere",
                       "put a corner between them");
    }
  }
  if (different.size() < 3) {
    throw UsageError("polygon", "a ring has only " + std::to_string(different.size()) + " different corners",
                     kHowToWrite);
  }
}

std::string Polygon::edge_name(const Edge& edge) const {
  const auto in_words = [](std::size_t n) { return std::to_string(n + 1); };
  std::string name = "the edge from corner " + in_words(edge.number);
  if (ring_count_ > 1) name += " of ring " + in_words(edge.ring);
  if (polygon_count_ > 1) name += " of polygon " + in_words(edge.polygon);
  return name;
}

void Polygon::refuse_crossings() const {
  for (std::uint32_t k = 0; k < edges_.size(); ++k) {
    const Edge& e = edges_[k];
    const Box box = arc_box(e.circle.a(), e.circle.b());
    tree_.any([&](const Box& other) { return box.meets(other); },
              [&](std::uint32_t m) {
                const Edge& f = edges_[m];
                if (m <= k || f.polygon != e.polygon || !crosses_inside(e.circle, f.circle)) return false;
                throw UsageError("polygon", edge_name(e) + " crosses " + edge_name(f),
                                 "give the corners in order along the border");
              });
  }
}

void Polygon::find_references() {
  constexpr int kTries = 64;
  constexpr double kClear = 1e-6;  // radians from every edge, so that areas seen from there are exact enough
  for (int attempt = 0; attempt < kTries && references_.empty(); ++attempt) {
    const auto candidates = askew_tetrahedron(attempt);
    const bool clear = std::none_of(candidates.begin(), candidates.end(), [&](const dvec3& u) {
      const Box around = box_around(std::span<const dvec3>(&u, 1), kClear);
      return tree_.any([&](const Box& box) { return around.meets(box); },
                       [&](std::uint32_t k) {
                         return std::abs(glm::dot(glm::normalize(edges_[k].circle.normal()), u)) < kClear;
                       });
    });
    if (!clear) continue;
    for (const dvec3& u : candidates) references_.push_back({u, {}});
  }
  if (references_.empty())
    throw UsageError("polygon", "its edges are everywhere", "give a polygon with fewer edges");
  Reference& first = references_[0];
  for (std::size_t k = 0; k < edges_.size();) {
    const Edge& edge = edges_[k];
    std::vector<dvec3> ring;
    for (; k < edges_.size() && edges_[k].polygon == edge.polygon && edges_[k].ring == edge.ring; ++k)
      ring.push_back(edges_[k].circle.a());
    if (smaller_side_is_opposite(ring, -first.at)) toggle(first.holders, edge.polygon);
  }
  for (std::size_t k = 1; k < references_.size(); ++k) {
    references_[k].holders = holders(first, references_[k].at);
  }
}

bool Polygon::on_an_edge(const dvec3& u) const {
  const Box around = box_around(std::span<const dvec3>(&u, 1), 0.0);
  return tree_.any([&](const Box& box) { return around.meets(box); },
                   [&](std::uint32_t k) { return on_edge(edges_[k].circle, u); });
}

void Polygon::find_surroundings() {
  constexpr double kWidest = 1.2;  // chord; above 70 degrees a cone around everything saves little
  constexpr double kBeyondRounding = 1.0 + 1e-9;
  dvec3 sum(0.0);
  for (const Edge& edge : edges_) sum += edge.circle.a();
  if (glm::dot(sum, sum) == 0.0) return;
  const dvec3 middle = glm::normalize(sum);
  double chord2 = 0;
  for (const Edge& edge : edges_) chord2 = std::max(chord2, squared_distance(middle, edge.circle.a()));
  const double chord = std::sqrt(chord2) * kBeyondRounding + kMargin;
  if (chord > kWidest) return;
  // A cone of less than 90 degrees that holds the ends of an edge holds the edge.
  around_.emplace(middle, 2.0 * std::asin(0.5 * chord) * (180.0 / std::numbers::pi));
  held_beyond_ = held(-middle);
  // A reference close by: shorter arcs meet fewer edges.
  if (!on_an_edge(middle)) references_.push_back({middle, holders(nearest_reference(middle), middle)});
}

template <typename Visit>
void Polygon::visit_crossed(const dvec3& p, const dvec3& u, const Visit& visit) const {
  const GreatCircle arc(p, u);
  const Box around = arc_box(p, u);
  const dvec3 magnitude = 0.5 * glm::abs(arc.normal());
  const auto may_meet = [&](const Box& box) {
    return around.meets(box) && std::abs(glm::dot(arc.normal(), 0.5 * (box.low + box.high))) <=
                                    glm::dot(magnitude, box.high - box.low) + 8.0 * kMargin;
  };
  tree_.any(may_meet, [&](std::uint32_t k) {
    if (crosses(arc, edges_[k].circle)) visit(edges_[k]);
    return false;
  });
}

std::vector<std::uint32_t> Polygon::holders(const Reference& from, const dvec3& u) const {
  std::vector<std::uint32_t> result = from.holders;
  visit_crossed(from.at, u, [&](const Edge& edge) { toggle(result, edge.polygon); });
  return result;
}

bool Polygon::held(const dvec3& u) const {
  const Reference& from = nearest_reference(u);
  if (polygon_count_ > 1) return !holders(from, u).empty();
  bool odd = !from.holders.empty();
  visit_crossed(from.at, u, [&](const Edge&) { odd = !odd; });
  return odd;
}

const Polygon::Reference& Polygon::nearest_reference(const dvec3& u) const {
  return *std::max_element(
      references_.begin(), references_.end(),
      [&](const Reference& a, const Reference& b) { return glm::dot(a.at, u) < glm::dot(b.at, u); });
}

bool Polygon::contains(const dvec3& u) const {
  if (around_ && !around_->contains(u)) return held_beyond_;
  return on_an_edge(u) || held(u);
}

Relation Polygon::relation(const Corners& t) const {
  const auto relation_if = [](bool inside) { return inside ? Relation::kInside : Relation::kDisjoint; };
  if (around_ && around_->relation(t) == Relation::kDisjoint) return relation_if(held_beyond_);
  const Box around = trixel_box(t);
  const std::array<GreatCircle, 3> sides{GreatCircle(t[0], t[1]), GreatCircle(t[1], t[2]),
                                         GreatCircle(t[2], t[0])};
  const auto beyond_a_side = [&](const GreatCircle& edge) {
    return std::any_of(sides.begin(), sides.end(), [&](const GreatCircle& side) {
      return side.side(edge.a()) < 0 && side.side(edge.b()) < 0;
    });
  };
  const auto all_to_one_side = [&](const GreatCircle& edge) {
    const int sign = edge.side(t[0]);
    return sign != 0 && edge.side(t[1]) == sign && edge.side(t[2]) == sign;
  };
  const bool touched = tree_.any([&](const Box& box) { return around.meets(box); },
                                 [&](std::uint32_t k) {
                                   const GreatCircle& edge = edges_[k].circle;
                                   return !beyond_a_side(edge) && !all_to_one_side(edge);
                                 });
  return touched ? Relation::kTouches : relation_if(held(t[0]));
}

std::vector<dvec3> Polygon::border_points() const {
  std::vector<dvec3> points;
  for (const Edge& edge : edges_) points.push_back(edge.circle.a());
  return points;
}

}  // namespace globe::htm
