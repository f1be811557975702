#include "globe/search/shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <utility>

#include "globe/base/error.h"
#include "globe/htm/border.h"
#include "globe/htm/cover.h"
#include "globe/search/region_touch.h"
#include "globe/search/schema.h"

namespace globe::search {
namespace {

using htm::dvec3;

/// A great-circle arc as a curve: t runs evenly along it.
class Arc final : public htm::Curve {
 public:
  Arc(const dvec3& a, const dvec3& b)
      : a_(a),
        b_(b),
        along_(glm::normalize(glm::cross(glm::cross(a + b, b - a), a))),
        length_(2.0 * std::atan2(glm::length(a - b), glm::length(a + b))) {}

  dvec3 at(double t) const override {
    if (t == 1.0) return b_;
    return std::cos(t * length_) * a_ + std::sin(t * length_) * along_;
  }
  double bend(double, double) const override { return length_ * length_; }

 private:
  dvec3 a_, b_, along_;
  double length_;
};

}  // namespace

/// Lines and polygons as a region, for their cover.
class Shape::Outline final : public htm::Region {
 public:
  explicit Outline(const Shape& shape) : shape_(shape), lines_(arcs(shape), 0.0) {}

  /// Lines hold no direction but by chance; nothing here asks.
  bool contains(const dvec3& u) const override { return shape_.polygons_ && shape_.polygons_->contains(u); }

  htm::Relation relation(const htm::Corners& trixel) const override {
    const htm::Relation relation =
        shape_.polygons_ ? shape_.polygons_->relation(trixel) : htm::Relation::kDisjoint;
    if (relation != htm::Relation::kDisjoint) return relation;
    return lines_.touches(trixel) ? htm::Relation::kTouches : relation;
  }

  std::vector<dvec3> border_points() const override { return {}; }

 private:
  static std::vector<std::shared_ptr<const htm::Curve>> arcs(const Shape& shape) {
    std::vector<std::shared_ptr<const htm::Curve>> result;
    for (const Line& line : shape.lines_) {
      for (std::size_t k = 1; k < line.size(); ++k)
        if (line[k - 1].u != line[k].u) result.push_back(std::make_shared<Arc>(line[k - 1].u, line[k].u));
    }
    return result;
  }

  const Shape& shape_;
  htm::Border lines_;
};

Shape::Line Shape::line_of(const geo::Geometry::Line& places) {
  Line line;
  for (const geo::Geodetic& at : places)
    line.push_back({at, geo::normal_from_degrees(at.lat_deg, at.lon_deg)});
  return line;
}

Shape::Shape(const geo::Geometry& geometry) : points_(line_of(geometry.points)) {
  constexpr double kOpposite2 = 1e-28;  // as htm::Polygon has it
  for (const geo::Geometry::Line& places : geometry.lines) {
    lines_.push_back(line_of(places));
    for (std::size_t k = 1; k < lines_.back().size(); ++k) {
      const dvec3 sum = lines_.back()[k - 1].u + lines_.back()[k].u;
      if (glm::dot(sum, sum) < kOpposite2) {
        throw UsageError("line", "place " + std::to_string(k) + " and the next are opposite on the sphere",
                         "put a place between them");
      }
    }
    // A line that stands still is a point.
    points_.push_back(lines_.back().front());
  }
  std::vector<htm::Polygon::Rings> polygons;
  for (const geo::Geometry::Rings& rings : geometry.polygons) {
    polygons.emplace_back();
    for (const geo::Geometry::Line& ring : rings) {
      Line line = line_of(ring);
      polygons.back().emplace_back();
      for (const Vertex& vertex : line) polygons.back().back().push_back(vertex.u);
      line.push_back(line.front());
      lines_.push_back(std::move(line));
    }
  }
  if (!polygons.empty()) polygons_.emplace(polygons);
}

bool Shape::touches(const htm::Region& region) const {
  for (const Vertex& point : points_)
    if (region.contains(point.u)) return true;
  for (const Line& line : lines_) {
    for (std::size_t k = 1; k < line.size(); ++k)
      if (search::touches(region, line[k - 1].u, line[k].u)) return true;
  }
  if (!polygons_) return false;
  // No edge comes near the region: parts of it lie inside the polygons wholly, with their borders, or not at
  // all.
  const std::vector<dvec3> border = region.border_points();
  return std::any_of(border.begin(), border.end(), [&](const dvec3& u) { return polygons_->contains(u); });
}

Nearest Shape::nearest(const GeographicLib::Geodesic& earth, const geo::Geodetic& from) const {
  if (polygons_ && polygons_->contains(geo::normal_from_degrees(from.lat_deg, from.lon_deg)))
    return {from, 0.0};
  NearestPlace nearest(earth, from);
  for (const Vertex& point : points_) nearest.look_at_point(point.at, point.u);
  for (const Line& line : lines_)
    for (const Vertex& vertex : line) nearest.look_at_point(vertex.at, vertex.u);
  for (const Line& line : lines_) {
    for (std::size_t k = 1; k < line.size(); ++k) nearest.look_at_edge(line[k - 1].u, line[k].u);
  }
  return nearest.best();
}

std::vector<htm::Trixel> Shape::cover() const {
  std::vector<htm::Trixel> trixels;
  if (!lines_.empty()) {
    const Outline outline(*this);
    for (int level = 0; level <= kIndexLevel; ++level) {
      std::vector<htm::Trixel> finer;
      htm::visit_cover(outline, {level, false, 0}, [&](const htm::IdRange& range) {
        htm::for_each_whole_trixel(level, range, [&](htm::Trixel t) { finer.push_back(t); });
      });
      if (level > 0 && finer.size() > kCover) break;
      trixels = std::move(finer);
    }
  }
  for (const Vertex& point : points_) trixels.push_back(htm::trixel_at(point.u, kIndexLevel));
  return trixels;
}

}  // namespace globe::search
