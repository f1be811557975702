#include "globe/search/feature_index.h"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "globe/base/error.h"
#include "globe/htm/trixel.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/search/folded_name.h"
#include "globe/search/hit_list.h"
#include "globe/search/key_ranges.h"
#include "globe/search/schema.h"
#include "globe/search/shape.h"
#include "globe/search/sqlite.h"
#include "globe/search/wkb.h"

namespace globe::search {
namespace {

#define GLOBE_POINT_COLUMNS "SELECT htm, id, lat, lon, name, properties FROM point "
#define GLOBE_SHAPE_COLUMNS "SELECT 0, id, lat, lon, name, properties, geometry FROM shape "

/// Opens for one long read, so that all questions see the same state.
Connection open(const std::filesystem::path& path) {
  Connection connection = Connection::open_read_only(path);
  connection.execute("PRAGMA cell_size_check = ON; PRAGMA cache_size = -65536; BEGIN");
  return connection;
}

/// Longer than any geodesic: radii of curvature are at most a²/b and b²/a.
double beyond_all_m(const geo::Ellipsoid& ellipsoid) {
  const double a = ellipsoid.a, b = ellipsoid.b();
  return std::numbers::pi * std::max(a * (a / b), b * (b / a));
}

}  // namespace

struct FeatureIndex::Parts {
  explicit Parts(const std::filesystem::path& file)
      : path(file),
        connection(open(file)),
        about(read_about(connection, file)),
        earth(about.ellipsoid.a, about.ellipsoid.f),
        all(connection, GLOBE_POINT_COLUMNS),
        range(connection, GLOBE_POINT_COLUMNS "WHERE htm BETWEEN ? AND ?"),
        after(connection, GLOBE_POINT_COLUMNS "WHERE htm >= ? ORDER BY htm, id"),
        before(connection, GLOBE_POINT_COLUMNS "WHERE htm < ? ORDER BY htm DESC, id DESC"),
        one(connection, GLOBE_POINT_COLUMNS "WHERE htm = ? AND id = ?"),
        all_shapes(connection, GLOBE_SHAPE_COLUMNS),
        one_shape(connection, GLOBE_SHAPE_COLUMNS "WHERE id = ?"),
        cover_range(connection, "SELECT id FROM cover WHERE htm BETWEEN ? AND ?"),
        cover_trixel(connection, "SELECT id FROM cover WHERE htm = ? AND level = ?"),
        names(connection, "SELECT folded, htm, id FROM name WHERE folded >= ? ORDER BY folded") {}

  Error damage(const std::string& what) const {
    return {path.string(), "it is damaged (" + what + ")", "index the features again"};
  }

  std::filesystem::path path;
  Connection connection;
  About about;
  GeographicLib::Geodesic earth;
  Statement all, range, after, before, one;  ///< points: all the same columns
  Statement all_shapes, one_shape;           ///< the same columns, and the geometry
  Statement cover_range, cover_trixel;
  Statement names;
};

/// One question on its way.
class FeatureIndex::Search {
 public:
  Search(Parts& parts, const Query& query)
      : parts_(parts),
        query_(query),
        folded_prefix_(folded_name(query.name_prefix)),
        radius_m_(query.radius_m),
        hits_(query.count) {}

  std::vector<Hit> run() {
    for (const auto& region : query_.regions) narrow(key_ranges(*region));
    const bool other_plan = ranges_ || radius_m_ || (query_.near && query_.count);
    if (folded_prefix_.empty() || !by_name(other_plan)) {
      if (query_.near && query_.count) {
        nearest();
      } else if (radius_m_) {
        within_radius();
      } else {
        by_ranges(ranges_);
      }
    }
    return std::move(hits_).sorted();
  }

 private:
  using Ranges = std::vector<htm::IdRange>;

  void narrow(Ranges ranges) { ranges_ = ranges_ ? intersection(*ranges_, ranges) : std::move(ranges); }

  bool passes_attributes(const Statement& row) const {
    if (!folded_prefix_.empty() && !folded_name(row.bytes(4)).starts_with(folded_prefix_)) return false;
    return std::all_of(query_.properties.begin(), query_.properties.end(),
                       [&](const PropertyTest& test) { return test.passes(row.bytes(5)); });
  }

  Hit hit_of(const Statement& row) const {
    const Hit hit{row.integer(1), static_cast<std::uint64_t>(row.integer(0)), row.real(2), row.real(3), 0.0};
    if (!(std::abs(hit.lat_deg) <= 90.0) || !(std::abs(hit.lon_deg) <= 180.0))
      throw parts_.damage("a place beyond the planet");
    return hit;
  }

  /// The point in a row, if it passes. `inside`: its trixel is known to lie in all regions.
  std::optional<Hit> passing_point(const Statement& row, bool inside) const {
    Hit hit = hit_of(row);
    if (query_.near) {
      const geo::Geodetic& near = *query_.near;
      parts_.earth.Inverse(near.lat_deg, near.lon_deg, hit.lat_deg, hit.lon_deg, hit.distance_m);
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

  /// The shape in a row, if it passes.
  std::optional<Hit> passing_shape(const Statement& row) const {
    if (!passes_attributes(row)) return std::nullopt;
    Hit hit = hit_of(row);
    if (!query_.near && query_.regions.empty()) return hit;
    const Shape shape = shape_of(row.bytes(6));
    if (query_.near) {
      const Nearest nearest = shape.nearest(parts_.earth, *query_.near);
      hit.distance_m = nearest.distance_m;
      hit.lat_deg = nearest.at.lat_deg;
      hit.lon_deg = std::remainder(nearest.at.lon_deg, 360.0);
      if (radius_m_ && hit.distance_m > *radius_m_) return std::nullopt;
    }
    for (const auto& region : query_.regions)
      if (!shape.touches(*region)) return std::nullopt;
    return hit;
  }

  Shape shape_of(std::string_view wkb) const {
    const std::optional<geo::Geometry> geometry = from_wkb(wkb);
    if (!geometry || geometry->empty()) throw parts_.damage("a geometry that is none");
    try {
      return Shape(*geometry);
    } catch (const UsageError& error) {
      throw parts_.damage(error.what());
    }
  }

  void consider_point(const Statement& row, bool inside) {
    if (const std::optional<Hit> hit = passing_point(row, inside)) hits_.add(*hit);
  }

  void consider_shape(std::int64_t id) {
    parts_.one_shape.with(id);
    if (!parts_.one_shape.step()) throw parts_.damage("a feature is missing");
    if (const std::optional<Hit> hit = passing_shape(parts_.one_shape)) hits_.add(*hit);
    parts_.one_shape.reset();
  }

  /// All features in the ranges, or everywhere.
  void by_ranges(const std::optional<Ranges>& ranges) {
    if (!ranges) return everywhere();
    for (const htm::IdRange& range : *ranges) {
      parts_.range.with(range.first, range.last);
      while (parts_.range.step()) consider_point(parts_.range, range.inside);
    }
    for (const std::int64_t id : shapes_in(*ranges)) consider_shape(id);
  }

  void everywhere() {
    parts_.all.with();
    while (parts_.all.step()) consider_point(parts_.all, false);
    parts_.all_shapes.with();
    while (parts_.all_shapes.step())
      if (const std::optional<Hit> hit = passing_shape(parts_.all_shapes)) hits_.add(*hit);
  }

  /// Shapes with a trixel of their cover in the ranges, or around one of them: each once.
  std::vector<std::int64_t> shapes_in(const Ranges& ranges) const {
    std::vector<std::int64_t> ids;
    if (parts_.about.shapes == 0) return ids;
    const auto gather = [&](Statement& statement) {
      while (statement.step()) ids.push_back(statement.integer(0));
    };
    for (const htm::IdRange& range : ranges) gather(parts_.cover_range.with(range.first, range.last));
    for (const Ancestor& trixel : ancestors(ranges))
      gather(parts_.cover_trixel.with(trixel.first, trixel.level));
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  void within_radius() {
    const region::EllipsoidCone cone(parts_.about.ellipsoid, *query_.near, *radius_m_);
    const Ranges around = key_ranges(cone);
    by_ranges(ranges_ ? intersection(*ranges_, around) : around);
  }

  /// By the names, if they are few or there is no other plan; false if they are many.
  bool by_name(bool other_plan) {
    constexpr std::size_t kMany = 20000;
    std::vector<std::pair<std::int64_t, std::int64_t>> found;
    const auto consider_found = [&] {
      for (const auto& [htm, id] : found) {
        if (htm == 0) {
          consider_shape(id);
          continue;
        }
        parts_.one.with(htm, id);
        if (!parts_.one.step()) throw parts_.damage("a feature is missing");
        consider_point(parts_.one, false);
        parts_.one.reset();
      }
      found.clear();
    };
    parts_.names.with(std::string_view(folded_prefix_));
    while (parts_.names.step() && parts_.names.bytes(0).starts_with(folded_prefix_)) {
      found.emplace_back(parts_.names.integer(1), parts_.names.integer(2));
      if (found.size() < kMany) continue;
      if (other_plan) return false;
      consider_found();
    }
    consider_found();
    return true;
  }

  void nearest() {
    const double asked_m = radius_m_.value_or(beyond_all_m(parts_.about.ellipsoid));
    constexpr double kFirstRing_m = 1000.0, kWider = 4.0;
    if (const std::optional<double> bound = distance_of_neighbours()) {
      radius_m_ = std::min(*bound, asked_m);
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

  /// A distance within which as many features as are asked for pass: that of the last of them among those
  /// next in the order of ids. Nothing when too few of the next pass.
  std::optional<double> distance_of_neighbours() {
    const std::size_t count = *query_.count;
    const std::size_t most = 4 * count + 256;
    const geo::Geodetic& near = *query_.near;
    const auto at = htm::trixel_at(geo::normal_from_degrees(near.lat_deg, near.lon_deg), kIndexLevel);
    HitList neighbours(count);
    for (Statement* side : {&parts_.after, &parts_.before}) {
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

  Parts& parts_;
  const Query& query_;
  std::string folded_prefix_;
  std::optional<double> radius_m_;  ///< within which features pass: as asked, or a ring
  std::optional<Ranges> ranges_;    ///< of the regions
  HitList hits_;
};

FeatureIndex::FeatureIndex(const std::filesystem::path& path) : parts_(std::make_unique<Parts>(path)) {}
FeatureIndex::~FeatureIndex() = default;
FeatureIndex::FeatureIndex(FeatureIndex&&) noexcept = default;

const geo::Ellipsoid& FeatureIndex::ellipsoid() const { return parts_->about.ellipsoid; }
std::uint64_t FeatureIndex::size() const { return parts_->about.points + parts_->about.shapes; }

std::vector<Hit> FeatureIndex::find(const Query& query) { return Search(*parts_, query).run(); }

FoundFeature FeatureIndex::read(const Hit& hit) {
  Statement& one = hit.htm == 0 ? parts_->one_shape.with(hit.id) : parts_->one.with(hit.htm, hit.id);
  if (!one.step()) throw parts_->damage("a feature is missing");
  FoundFeature feature{std::string(one.bytes(4)), std::string(one.bytes(5))};
  one.reset();
  return feature;
}

}  // namespace globe::search
