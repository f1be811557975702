#include "globe/region/map_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/predicates.h"

namespace globe::region {
namespace {

using htm::Box;
using htm::dvec3;

constexpr const char* kHowToDraw = "give three corners or more in order along the border";

dvec3 on_map(const MapPoint& p) { return {p.lon_deg, p.lat_deg, 1.0}; }

/// 1: c lies to the left of the line from a to b on the map, exactly; 0 on it.
int side(const MapPoint& a, const MapPoint& b, const MapPoint& c) {
  return htm::orientation(on_map(a), on_map(b), on_map(c)).sign;
}

Box map_box(const MapPoint& a, const MapPoint& b) {
  const std::array<dvec3, 2> ends{on_map(a), on_map(b)};
  return htm::box_around(ends, 0.0);
}

bool crosses_inside(const MapPoint& p, const MapPoint& q, const MapPoint& a, const MapPoint& b) {
  const int side_a = side(p, q, a), side_p = side(a, b, p);
  return side_a != 0 && side_p != 0 && side(p, q, b) == -side_a && side(a, b, q) == -side_p;
}

/// Distance from the origin to a line between two points of a plane.
double distance_to_line(double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay;
  const double length2 = dx * dx + dy * dy;
  const double t = length2 == 0.0 ? 0.0 : std::clamp(-(ax * dx + ay * dy) / length2, 0.0, 1.0);
  return std::hypot(ax + t * dx, ay + t * dy);
}

bool on_antimeridian(double lon_deg) { return std::remainder(lon_deg - 180.0, kTurn) == 0.0; }

}  // namespace

MapPolygon::MapPolygon(std::span<const Rings> polygons)
    : polygon_count_(polygons.size()), tree_({}), border_({}, kMapBorderMargin) {
  for (std::uint32_t p = 0; p < polygons.size(); ++p) {
    ring_count_ += polygons[p].size();
    for (std::uint32_t r = 0; r < polygons[p].size(); ++r) add_ring(polygons[p][r], p, r);
  }
  if (edges_.empty()) throw UsageError("polygon", "it has no corners", kHowToDraw);
  std::vector<Box> boxes;
  boxes.reserve(edges_.size());
  west_deg_ = east_deg_ = edges_[0].a.lon_deg;
  for (const Edge& edge : edges_) {
    boxes.push_back(map_box(edge.a, edge.b));
    west_deg_ = std::min(west_deg_, edge.a.lon_deg);
    east_deg_ = std::max(east_deg_, edge.a.lon_deg);
    north_pole_ = north_pole_ || edge.a.lat_deg == 90.0;
    south_pole_ = south_pole_ || edge.a.lat_deg == -90.0;
  }
  tree_ = htm::BoxTree(boxes);
  refuse_crossings();
  border_ = border();
}

void MapPolygon::add_ring(const Ring& ring, std::uint32_t polygon, std::uint32_t number) {
  std::set<std::array<double, 2>> different;
  for (std::uint32_t k = 0; k < ring.size(); ++k) {
    const MapPoint& a = ring[k];
    const MapPoint& b = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (!(std::abs(a.lat_deg) <= 90.0) || !(std::abs(a.lon_deg) <= 1e6))
      throw UsageError("polygon", "a corner is beyond the map", "give latitudes within 90 degrees");
    if (different.size() < 3) different.insert({a.lat_deg, a.lon_deg});
    if (!(a == b)) edges_.push_back({a, b, polygon, number, k});
  }
  if (different.size() < 3) {
    throw UsageError("polygon", "a ring has only " + std::to_string(different.size()) + " different corners",
                     kHowToDraw);
  }
}

std::string MapPolygon::edge_name(const Edge& edge) const {
  const auto in_words = [](std::size_t n) { return std::to_string(n + 1); };
  std::string name = "the edge from corner " + in_words(edge.number);
  if (ring_count_ > 1) name += " of ring " + in_words(edge.ring);
  if (polygon_count_ > 1) name += " of polygon " + in_words(edge.polygon);
  return name;
}

void MapPolygon::refuse_crossings() const {
  for (std::uint32_t k = 0; k < edges_.size(); ++k) {
    const Edge& e = edges_[k];
    const Box box = map_box(e.a, e.b);
    tree_.any([&](const Box& other) { return box.meets(other); },
              [&](std::uint32_t m) {
                const Edge& f = edges_[m];
                if (m <= k || f.polygon != e.polygon || !crosses_inside(e.a, e.b, f.a, f.b)) return false;
                throw UsageError("polygon", edge_name(e) + " crosses " + edge_name(f),
                                 "give the corners in order along the border");
              });
  }
}

htm::Border MapPolygon::border() const {
  std::vector<std::shared_ptr<const htm::Curve>> lines;
  const auto add = [&](const MapPoint& a, const MapPoint& b) {
    lines.push_back(std::make_shared<MapLine>(a, b));
  };
  // How often each stretch of the antimeridian is an edge, by the latitudes where that changes.
  std::map<double, int> seam;
  for (const Edge& edge : edges_) {
    const auto& [a, b] = std::pair(edge.a, edge.b);
    if (a.lat_deg == b.lat_deg && std::abs(a.lat_deg) == 90.0) continue;
    if (a.lon_deg == b.lon_deg && on_antimeridian(a.lon_deg)) {
      ++seam[std::min(a.lat_deg, b.lat_deg)];
      --seam[std::max(a.lat_deg, b.lat_deg)];
    } else {
      add(a, b);
    }
  }
  int depth = 0;
  double south = -90.0;
  for (const auto& [lat, change] : seam) {
    if (depth % 2 != 0) add({south, 180.0}, {lat, 180.0});
    depth += change;
    south = lat;
  }
  return {std::move(lines), kMapBorderMargin};
}

bool MapPolygon::contains_on_map(const MapPoint& at) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Near a pole a degree of longitude is short: the border's width reaches over many of them.
  const double shrink = std::cos(at.lat_deg * (M_PI / 180.0));
  const double reach = std::min(kMapBorderDeg / std::max(shrink, 1e-300), 1e9);
  const Box around{{at.lon_deg - reach, at.lat_deg - kMapBorderDeg, -kInfinity},
                   {at.lon_deg + reach, at.lat_deg + kMapBorderDeg, kInfinity}};
  const bool on_border = tree_.any(
      [&](const Box& box) { return around.meets(box); },
      [&](std::uint32_t k) {
        const auto& [a, b] = std::pair(edges_[k].a, edges_[k].b);
        return distance_to_line((a.lon_deg - at.lon_deg) * shrink, a.lat_deg - at.lat_deg,
                                (b.lon_deg - at.lon_deg) * shrink, b.lat_deg - at.lat_deg) <= kMapBorderDeg;
      });
  if (on_border) return true;
  // Edges that a ray to the north crosses, by polygon.
  const Box ray{{at.lon_deg, at.lat_deg, -kInfinity}, {at.lon_deg, kInfinity, kInfinity}};
  std::vector<std::uint32_t> crossed;
  tree_.any([&](const Box& box) { return ray.meets(box); },
            [&](std::uint32_t k) {
              const auto& [west, east] =
                  std::minmax(edges_[k].a, edges_[k].b,
                              [](const MapPoint& p, const MapPoint& q) { return p.lon_deg < q.lon_deg; });
              if (west.lon_deg <= at.lon_deg && at.lon_deg < east.lon_deg && side(west, east, at) < 0)
                crossed.push_back(edges_[k].polygon);
              return false;
            });
  std::sort(crossed.begin(), crossed.end());
  for (auto first = crossed.begin(); first != crossed.end();) {
    const auto last = std::upper_bound(first, crossed.end(), *first);
    if ((last - first) % 2 != 0) return true;
    first = last;
  }
  return false;
}

bool MapPolygon::contains(const dvec3& u) const {
  if (u.x == 0.0 && u.y == 0.0) return u.z > 0.0 ? north_pole_ : south_pole_;
  const geo::Geodetic at = geo::degrees_from_normal(u);
  const double first = west_deg_ - 1e-6;
  double lon = at.lon_deg + kTurn * std::ceil((first - at.lon_deg) / kTurn);
  for (; lon <= east_deg_ + 1e-6; lon += kTurn)
    if (contains_on_map({at.lat_deg, lon})) return true;
  return false;
}

htm::Relation MapPolygon::relation(const htm::Corners& trixel) const {
  if (border_.touches(trixel)) return htm::Relation::kTouches;
  return contains(trixel[0]) ? htm::Relation::kInside : htm::Relation::kDisjoint;
}

std::vector<dvec3> MapPolygon::border_points() const {
  std::vector<dvec3> points;
  for (const Edge& edge : edges_) points.push_back(geo::normal_from_degrees(edge.a.lat_deg, edge.a.lon_deg));
  return points;
}

}  // namespace globe::region
