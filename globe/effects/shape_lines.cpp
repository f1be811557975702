#include "globe/effects/shape_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"

namespace globe::effects {
namespace {

constexpr double kLongest = 1.0 / 16.0;  ///< arc, of its distance
constexpr double kWidest = 0.5;          ///< arc, of the planet's radius
constexpr int kDeepest = 48;             ///< halvings of an edge

/// Of the sphere around the ground between two heights that stands on a sphere of the ellipsoid.
double grown(double radius_m, double low_m, double high_m) {
  return radius_m * 1.003 + 0.5 * (high_m - low_m);
}

}  // namespace

ShapeLine::ShapeLine(const geo::Ellipsoid& ellipsoid, std::vector<MapCorner> corners, float half_width_px)
    : ellipsoid_(ellipsoid), corners_(std::move(corners)), half_width_px_(half_width_px) {
  places_.reserve(corners_.size());
  for (const MapCorner& corner : corners_) places_.push_back(place_of(corner.lat_deg, corner.lon_deg));
  if (corners_.size() < 2) return;
  for (std::uint32_t k = 0; k + 1 < corners_.size(); ++k) bends_.push_back(bend_of(k, 0.0, 1.0));
  nodes_.reserve(2 * corners_.size());
  nodes_.emplace_back();
  build(0, static_cast<std::uint32_t>(corners_.size() - 1));
}

ShapeLine::Place ShapeLine::place_of(double lat_deg, double lon_deg) const {
  const glm::dvec3 u = geo::normal_from_degrees(std::clamp(lat_deg, -90.0, 90.0), lon_deg);
  return {u, geo::surface_point(ellipsoid_, u)};
}

double ShapeLine::length_of(std::uint32_t edge, double t0, double t1) const {
  const MapCorner &a = corners_[edge], &b = corners_[edge + 1];
  const double lat0 = a.lat_deg + t0 * (b.lat_deg - a.lat_deg),
               lat1 = a.lat_deg + t1 * (b.lat_deg - a.lat_deg);
  const double nearest_equator = lat0 * lat1 <= 0.0 ? 0.0 : std::min(std::abs(lat0), std::abs(lat1));
  const double across = (b.lon_deg - a.lon_deg) * std::cos(nearest_equator * kDegree);
  return std::hypot(across, b.lat_deg - a.lat_deg) * (t1 - t0) * kDegree * 1.01 *
         std::max(ellipsoid_.a, ellipsoid_.b());
}

double ShapeLine::bend_of(std::uint32_t edge, double t0, double t1) const {
  const MapCorner &a = corners_[edge], &b = corners_[edge + 1];
  const double lat0 = a.lat_deg + t0 * (b.lat_deg - a.lat_deg),
               lat1 = a.lat_deg + t1 * (b.lat_deg - a.lat_deg);
  const double phi = std::abs(b.lat_deg - a.lat_deg) * kDegree * (t1 - t0);
  const double lambda = std::abs(b.lon_deg - a.lon_deg) * kDegree * (t1 - t0);
  const double nearest_equator = lat0 * lat1 <= 0.0 ? 0.0 : std::min(std::abs(lat0), std::abs(lat1));
  const double farthest = std::sin(std::max(std::abs(lat0), std::abs(lat1)) * kDegree);
  // Across the arc between its ends, of u'' = φ'² (-u) + 2 φ'λ' (-sin φ e⊥) + λ'² (-cos φ e): the first part
  // lies in the arc's own plane, and so does what of the last does not point along the meridian.
  const double aside =
      2.0 * phi * lambda * farthest + lambda * lambda * farthest * std::cos(nearest_equator * kDegree);
  return 0.125 * aside * 1.02 * std::max(ellipsoid_.a, ellipsoid_.b());
}

std::uint32_t ShapeLine::build(std::uint32_t first, std::uint32_t last) {
  const auto index = static_cast<std::uint32_t>(nodes_.size() - 1);
  Node node{first, last, 0, 0, {}, 0.0};
  if (last == first + 1) {
    const MapCorner &a = corners_[first], &b = corners_[last];
    node.around.centre = place_of(0.5 * (a.lat_deg + b.lat_deg), 0.5 * (a.lon_deg + b.lon_deg)).at;
    node.around.radius = 0.5 * length_of(first, 0.0, 1.0);
  } else {
    const std::uint32_t middle = first + (last - first) / 2;
    nodes_.emplace_back();
    node.left = build(first, middle);
    nodes_.emplace_back();
    node.right = build(middle, last);
    const Sphere &l = nodes_[node.left].around, &r = nodes_[node.right].around;
    const double apart = glm::distance(l.centre, r.centre);
    if (apart + r.radius <= l.radius) {
      node.around = l;
    } else if (apart + l.radius <= r.radius) {
      node.around = r;
    } else {
      const double radius = 0.5 * (apart + l.radius + r.radius);
      node.around = {l.centre + (r.centre - l.centre) * ((radius - l.radius) / apart), radius};
    }
  }
  node.error_m = error_of(node);
  nodes_[index] = node;
  return index;
}

double ShapeLine::error_of(const Node& node) const {
  if (node.left == 0) return bends_[node.first];
  const glm::dvec3 a = places_[node.first].at, b = places_[node.last].at;
  const glm::dvec3 up = glm::normalize(a + b);
  glm::dvec3 along = b - a;
  along -= up * glm::dot(up, along);
  const double length = glm::length(along);
  if (length > 0.0) along /= length;
  double error = 0.0;
  for (std::uint32_t k = node.first; k < node.last; ++k) {
    glm::dvec3 from_a = places_[k].at - a;
    from_a -= up * glm::dot(up, from_a);
    const double t = glm::dot(along, from_a);
    const double off = glm::length(from_a - along * std::clamp(t, 0.0, length));
    error = std::max(error, off + bends_[k]);
  }
  return error;
}

void ShapeLine::add_arcs(const LineView& view, std::vector<Arc>& arcs) const {
  if (!nodes_.empty()) return visit(0, view, arcs);
  if (!may_be_seen(view)) return;
  const Place& only = places_.front();
  const double distance = glm::distance(only.at + only.u * view.ground_m, view.eye);
  add_arc(only, only, std::max(distance, view.above_m), view, arcs);
}

bool ShapeLine::may_be_seen(const LineView& view) const {
  if (!nodes_.empty()) return may_be_seen(nodes_.front(), view);
  const Place& only = places_.front();
  const double radius = grown(0.0, view.lowest_m, view.highest_m);
  const glm::dvec3 centre = only.at + only.u * (0.5 * (view.lowest_m + view.highest_m));
  return view.frustum.sees(centre - view.eye, radius) && view.horizon.sees(centre, radius, view.highest_m);
}

bool ShapeLine::may_be_seen(const Node& node, const LineView& view) const {
  const glm::dvec3 up = vertical_of(node);
  double radius = grown(node.around.radius, view.lowest_m, view.highest_m);
  // Where ends are not near each other their mean vertical says nothing of heights.
  if (node.around.radius > 1e-2 * ellipsoid_.a) radius += std::max(view.highest_m, -view.lowest_m);
  const glm::dvec3 centre = node.around.centre + up * (0.5 * (view.lowest_m + view.highest_m));
  return view.frustum.sees(centre - view.eye, radius) && view.horizon.sees(centre, radius, view.highest_m);
}

glm::dvec3 ShapeLine::vertical_of(const Node& node) const {
  const glm::dvec3 up = places_[node.first].u + places_[node.last].u;
  const double length = glm::length(up);
  return length > 1e-3 ? up / length : places_[node.first].u;
}

void ShapeLine::visit(std::uint32_t index, const LineView& view, std::vector<Arc>& arcs) const {
  const Node& node = nodes_[index];
  if (!may_be_seen(node, view)) return;
  if (node.left == 0)
    return visit_edge(node.first, {0.0, 1.0, places_[node.first], places_[node.last]}, 0, view, arcs);
  const double distance = std::max(
      glm::distance(node.around.centre + vertical_of(node) * view.ground_m, view.eye) - node.around.radius,
      view.above_m);
  if (node.error_m <= view.tolerance_px * view.pixel * distance && node.around.radius <= kLongest * distance)
    return add_arc(places_[node.first], places_[node.last], distance, view, arcs);
  visit(node.left, view, arcs);
  visit(node.right, view, arcs);
}

void ShapeLine::visit_edge(std::uint32_t edge, const Part& part, int depth, const LineView& view,
                           std::vector<Arc>& arcs) const {
  const MapCorner &a = corners_[edge], &b = corners_[edge + 1];
  const double t = 0.5 * (part.t0 + part.t1);
  const Place middle =
      place_of(a.lat_deg + t * (b.lat_deg - a.lat_deg), a.lon_deg + t * (b.lon_deg - a.lon_deg));
  const double length = length_of(edge, part.t0, part.t1);
  if (depth > 0) {
    const double radius = grown(0.5 * length, view.lowest_m, view.highest_m);
    const glm::dvec3 centre = middle.at + middle.u * (0.5 * (view.lowest_m + view.highest_m));
    if (!view.frustum.sees(centre - view.eye, radius) || !view.horizon.sees(centre, radius, view.highest_m))
      return;
  }
  const double distance =
      std::max(glm::distance(middle.at + middle.u * view.ground_m, view.eye) - 0.5 * length, view.above_m);
  const bool fine = bend_of(edge, part.t0, part.t1) <= view.tolerance_px * view.pixel * distance &&
                    length <= std::min(kLongest * distance, kWidest * ellipsoid_.a);
  if (fine || depth == kDeepest) return add_arc(part.a, part.b, distance, view, arcs);
  visit_edge(edge, {part.t0, t, part.a, middle}, depth + 1, view, arcs);
  visit_edge(edge, {t, part.t1, middle, part.b}, depth + 1, view, arcs);
}

void ShapeLine::add_arc(const Place& a, const Place& b, double distance_m, const LineView& view,
                        std::vector<Arc>& arcs) const {
  const glm::dvec3 up = glm::normalize(a.u + b.u);
  const double chord = glm::distance(a.at, b.at);
  const glm::dvec2 heights = view.ground(up, chord, distance_m);
  const double middle_m = 0.5 * (heights.x + heights.y);
  const glm::dvec3 from = a.at + a.u * middle_m - view.eye, to = b.at + b.u * middle_m - view.eye;
  const double half_px = (static_cast<double>(half_width_px_) + 3.0) * view.pixel * distance_m * 2.0;
  const double rises = chord * chord / (7.0 * std::min(ellipsoid_.a, ellipsoid_.b()));
  const double radius = 0.5 * chord + 0.5 * (heights.y - heights.x) + rises + half_px;
  if (!view.frustum.sees(0.5 * (from + to), radius)) return;
  glm::dvec3 along = to - from;
  along -= up * glm::dot(up, along);
  double length = glm::length(along);
  if (length > 0.0) {
    along /= length;
  } else {
    along = std::abs(up.z) < 0.9 ? glm::dvec3(-up.y, up.x, 0.0) : glm::dvec3(0.0, -up.z, up.y);
    along = glm::normalize(along);
  }
  const glm::dvec3 across = glm::cross(up, along);
  const double half_m = 0.5 * (heights.y - heights.x);
  arcs.push_back({glm::vec4(glm::dvec4(from, -half_m)), glm::vec4(glm::dvec4(to, half_m + rises)),
                  glm::vec4(glm::vec3(a.u), half_width_px_), glm::vec4(glm::dvec4(b.u, length)),
                  glm::vec4(glm::dvec4(across, glm::dot(across, from))),
                  glm::vec4(glm::dvec4(along, glm::dot(along, from)))});
}

}  // namespace globe::effects
