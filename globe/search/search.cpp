#include "globe/search/search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "globe/base/error.h"
#include "globe/htm/cone.h"
#include "globe/htm/trixel.h"
#include "globe/search/folded_name.h"
#include "globe/search/key_ranges.h"
#include "globe/search/wkb.h"

namespace globe::search {
namespace {

/// The angle between normals (degrees) beyond which everything is farther than a distance: a metre on the
/// ellipsoid turns the normal by one over the smallest radius of curvature at most.
double degrees_of(const geo::Ellipsoid& ellipsoid, double distance_m) {
  constexpr double kRounding = 1e-14;
  const double a = ellipsoid.a, b = ellipsoid.b();
  const double least_m = std::min(a * (a / b), b * (b / a));
  const double angle = distance_m / least_m * (1.0 + kRounding) + kRounding;
  return std::min(angle * (180.0 / std::numbers::pi), 180.0);
}

/// Longer than any geodesic that is the shortest: half a turn of the greatest radius of curvature.
double beyond_all_m(const geo::Ellipsoid& ellipsoid) {
  const double a = ellipsoid.a, b = ellipsoid.b();
  return std::numbers::pi * std::max(a * (a / b), b * (b / a));
}

}  // namespace

Search::Search(OpenDatabase& database, const Query& query)
    : database_(database),
      query_(query),
      folded_prefix_(folded_name(query.name_prefix)),
      near_normal_(query.near ? geo::normal_from_degrees(query.near->lat_deg, query.near->lon_deg)
                              : htm::dvec3(0.0)),
      radius_m_(query.radius_m),
      hits_(query.count) {}

std::vector<Hit> Search::run() {
  for (const auto& region : query_.regions) {
    const Ranges ranges = key_ranges(*region, true);
    ranges_ = ranges_ ? intersection(*ranges_, ranges) : ranges;
  }
  const bool k_nearest = query_.near && query_.count;
  const bool found_by_name = !folded_prefix_.empty() && by_name(ranges_ || radius_m_ || k_nearest);
  if (found_by_name) return std::move(hits_).sorted();
  if (k_nearest) {
    nearest();
  } else if (radius_m_) {
    within_radius();
  } else if (ranges_) {
    by_ranges(*ranges_);
  } else {
    everywhere();
  }
  return std::move(hits_).sorted();
}

bool Search::passes_attributes(const Statement& row) const {
  if (!folded_prefix_.empty() && !folded_name(row.bytes(4)).starts_with(folded_prefix_)) return false;
  return std::all_of(query_.properties.begin(), query_.properties.end(),
                     [&](const PropertyTest& test) { return test.passes(row.bytes(5)); });
}

Hit Search::hit_of(const Statement& row) const {
  const Hit hit{row.integer(1), static_cast<std::uint64_t>(row.integer(0)), row.real(2), row.real(3), 0.0};
  if (!(std::abs(hit.lat_deg) <= 90.0) || !(std::abs(hit.lon_deg) <= 180.0))
    throw database_.damage("a place beyond the planet");
  return hit;
}

std::optional<Hit> Search::passing_point(const Statement& row, bool inside) const {
  Hit hit = hit_of(row);
  if (query_.near) {
    const geo::Geodetic& near = *query_.near;
    database_.earth.Inverse(near.lat_deg, near.lon_deg, hit.lat_deg, hit.lon_deg, hit.distance_m);
    if (radius_m_ && hit.distance_m > *radius_m_) return std::nullopt;
  }
  if (!inside && !query_.regions.empty()) {
    const htm::dvec3 u = geo::normal_from_degrees(hit.lat_deg, hit.lon_deg);
    for (const auto& region : query_.regions)
      if (!region->contains(u)) return std::nullopt;
  }
  if (!passes_attributes(row)) return std::nullopt;
  return hit;
}

std::optional<Hit> Search::passing_shape(const Statement& row) const {
  if (!passes_attributes(row)) return std::nullopt;
  Hit hit = hit_of(row);
  if (!query_.near && query_.regions.empty()) return hit;
  const Shape shape = shape_of(row.bytes(6));
  if (query_.near) {
    const Nearest nearest = shape.nearest(database_.earth, *query_.near);
    hit.distance_m = nearest.distance_m;
    hit.lat_deg = nearest.at.lat_deg;
    hit.lon_deg = std::remainder(nearest.at.lon_deg, 360.0);
    if (radius_m_ && hit.distance_m > *radius_m_) return std::nullopt;
  }
  for (const auto& region : query_.regions)
    if (!shape.touches(*region)) return std::nullopt;
  return hit;
}

Shape Search::shape_of(std::string_view wkb) const {
  const std::optional<geo::Geometry> geometry = from_wkb(wkb);
  if (!geometry || geometry->empty()) throw database_.damage("a geometry that is none");
  try {
    return Shape(*geometry);
  } catch (const UsageError& error) {
    throw database_.damage(error.what());
  }
}

void Search::consider_point(const Statement& row, bool inside) {
  if (const std::optional<Hit> hit = passing_point(row, inside)) hits_.add(*hit);
}

void Search::consider_shape(std::int64_t id) {
  Statement& shape = database_.one_shape.with(id);
  if (!shape.step()) throw database_.damage("a feature is missing");
  if (const std::optional<Hit> hit = passing_shape(shape)) hits_.add(*hit);
  shape.reset();
}

void Search::consider_named(std::int64_t htm, std::int64_t id) {
  if (htm == 0) return consider_shape(id);
  Statement& point = database_.one_point.with(htm, id);
  if (!point.step()) throw database_.damage("a feature is missing");
  consider_point(point, false);
  point.reset();
}

void Search::everywhere() {
  Statement& points = database_.all_points.with();
  while (points.step()) consider_point(points, false);
  Statement& shapes = database_.all_shapes.with();
  while (shapes.step())
    if (const std::optional<Hit> hit = passing_shape(shapes)) hits_.add(*hit);
}

void Search::by_ranges(const Ranges& ranges) {
  for (const htm::IdRange& range : ranges) {
    Statement& points = database_.points_between.with(range.first, range.last);
    while (points.step()) consider_point(points, range.inside);
  }
  for (const std::int64_t id : shapes_in(ranges)) consider_shape(id);
}

std::vector<std::int64_t> Search::shapes_in(const Ranges& ranges) const {
  std::vector<std::int64_t> ids;
  if (database_.about.shapes == 0) return ids;
  const auto gather = [&](Statement& statement) {
    while (statement.step()) ids.push_back(statement.integer(0));
  };
  for (const htm::IdRange& range : ranges) gather(database_.covers_between.with(range.first, range.last));
  for (const Ancestor& trixel : ancestors(ranges))
    gather(database_.covers_of.with(trixel.first, trixel.level));
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

void Search::within_radius() {
  // The cone between normals that holds the geodesic circle; on the Earth it is 1 % wider at most.
  const htm::Cone cone(near_normal_, degrees_of(database_.about.ellipsoid, *radius_m_));
  Ranges around = key_ranges(cone, false);
  // The distance is measured anyway: what else there is to test is up to the regions.
  for (htm::IdRange& range : around) range.inside = true;
  by_ranges(ranges_ ? intersection(*ranges_, around) : around);
}

bool Search::by_name(bool other_way) {
  constexpr std::size_t kMany = 20000;
  std::vector<std::pair<std::int64_t, std::int64_t>> found;
  const auto consider_found = [&] {
    for (const auto& [htm, id] : found) consider_named(htm, id);
    found.clear();
  };
  Statement& names = database_.names_from.with(std::string_view(folded_prefix_));
  while (names.step() && names.bytes(0).starts_with(folded_prefix_)) {
    found.emplace_back(names.integer(1), names.integer(2));
    if (found.size() < kMany) continue;
    if (other_way) {
      names.reset();
      return false;
    }
    consider_found();
  }
  consider_found();
  names.reset();
  return true;
}

void Search::nearest() {
  constexpr double kFirstRing_m = 1000.0, kWider = 4.0;
  const double asked_m = radius_m_.value_or(beyond_all_m(database_.about.ellipsoid));
  if (const std::optional<double> bound_m = distance_of_neighbours()) {
    radius_m_ = std::min(*bound_m, asked_m);
    return within_radius();
  }
  for (double ring_m = kFirstRing_m; ring_m < asked_m; ring_m *= kWider) {
    radius_m_ = ring_m;
    within_radius();
    if (hits_.full()) return;
    hits_ = HitList(query_.count);
  }
  radius_m_ = asked_m;
  within_radius();
}

std::optional<double> Search::distance_of_neighbours() {
  const std::size_t count = *query_.count;
  const std::size_t most = 4 * count + 256;  // to be looked at on each side
  const htm::Trixel at = htm::trixel_at(near_normal_, kIndexLevel);
  HitList neighbours(count);
  for (Statement* side : {&database_.points_from, &database_.points_before}) {
    side->with(at.id);
    std::size_t passed = 0;
    for (std::size_t looked = 0; looked < most && passed < count && side->step(); ++looked) {
      const std::optional<Hit> hit = passing_point(*side, false);
      if (!hit) continue;
      neighbours.add(*hit);
      ++passed;
    }
    side->reset();
  }
  if (!neighbours.full() || count == 0) return std::nullopt;
  return neighbours.worst_m();
}

}  // namespace globe::search
