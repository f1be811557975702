// Covers against brute force: no point of the region outside the outer cover, none outside the region in the
// inner one.

#include "globe/htm/cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/geo/geodesic_circle.h"
#include "globe/htm/complement.h"
#include "globe/htm/cone.h"
#include "globe/htm/polygon.h"
#include "globe/htm/trixel.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"
#include "globe/region/map_polygon.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace {

using globe::geo::normal_from_degrees;
using globe::htm::Cone;
using globe::htm::cover;
using globe::htm::dvec3;
using globe::htm::IdRange;
using globe::htm::Polygon;
using globe::htm::Region;
using globe::htm::Trixel;
using globe::htm::trixel_at;

using RegionPointer = std::shared_ptr<const Region>;

/// A region, and how far around a place (radians) points are tried.
struct CoverCase {
  std::string name;
  RegionPointer region;
  dvec3 place;
  double reach_rad;
  std::vector<dvec3> border = {};  ///< points of the border, tried too
};

bool holds(const std::vector<IdRange>& ranges, std::uint64_t id) {
  const auto after =
      std::upper_bound(ranges.begin(), ranges.end(), id,
                       [](std::uint64_t key, const IdRange& range) { return key < range.first; });
  return after != ranges.begin() && std::prev(after)->last >= id;
}

/// A direction within some angle of another, near and far alike.
dvec3 near(std::mt19937_64& random, const dvec3& u, double reach_rad) {
  std::uniform_real_distribution<double> unit(0, 1);
  const dvec3 side = glm::normalize(glm::cross(u, hard::random_direction(random)));
  const double angle = reach_rad * std::sqrt(unit(random));
  return glm::normalize(std::cos(angle) * u + std::sin(angle) * side);
}

/// The level whose trixels are about a fraction of the reach wide.
int level_for(double reach_rad, int finer) {
  const int level = static_cast<int>(std::lround(std::log2(M_PI / 2 / reach_rad))) + finer;
  return std::clamp(level, 0, globe::htm::kMaxLevel);
}

bool in_order(const std::vector<IdRange>& ranges, int level) {
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    if (ranges[k].first > ranges[k].last || ranges[k].first < 8ULL << (2 * level) ||
        ranges[k].last >= 16ULL << (2 * level))
      return false;
    if (k > 0 && ranges[k].first <= ranges[k - 1].last + 1) return false;
  }
  return true;
}

bool is_subset(const std::vector<IdRange>& inner, const std::vector<IdRange>& outer) {
  return std::all_of(inner.begin(), inner.end(),
                     [&](const IdRange& r) { return holds(outer, r.first) && holds(outer, r.last); });
}

struct Tally {
  std::size_t points = 0, missed = 0, wrongly_inside = 0, disordered = 0, over_budget = 0;
  std::string where;  ///< the last case with a fault

  std::size_t faults() const { return missed + wrongly_inside + disordered + over_budget; }
};

void try_case(const CoverCase& c, std::mt19937_64& random, std::size_t points, Tally& tally) {
  const std::size_t faults_before = tally.faults();
  std::vector<dvec3> places;
  for (std::size_t k = 0; k < points; ++k) {
    if (!c.border.empty() && k % 2 == 0) {
      const dvec3& on = c.border[random() % c.border.size()];
      const double reach = c.reach_rad * std::ldexp(1.0, -static_cast<int>(random() % 40));
      places.push_back(k % 8 == 0 ? on : near(random, on, reach));
    } else {
      places.push_back(near(random, c.place, c.reach_rad));
    }
  }
  std::vector<bool> contained;
  contained.reserve(places.size());
  for (const dvec3& u : places) contained.push_back(c.region->contains(u));
  for (const int finer : {0, 3, 6}) {
    const int level = level_for(c.reach_rad, finer);
    const auto outer = cover(*c.region, {level, false, 0});
    const auto inner = cover(*c.region, {level, true, 0});
    tally.disordered += !in_order(outer, level) + !in_order(inner, level) + !is_subset(inner, outer);
    std::vector<std::vector<IdRange>> outers{outer}, inners{inner};
    for (const std::size_t budget : {std::size_t{1}, std::size_t{5}, std::size_t{20}}) {
      outers.push_back(cover(*c.region, {level, false, budget}));
      inners.push_back(cover(*c.region, {level, true, budget}));
      for (const auto& ranges : {outers.back(), inners.back()}) {
        tally.over_budget += ranges.size() > budget;
        tally.disordered += !in_order(ranges, level);
      }
      tally.disordered += !is_subset(outer, outers.back()) + !is_subset(inners.back(), inner);
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const dvec3& u = places[k];
      const std::uint64_t id = trixel_at(u, level).id;
      const bool inside = contained[k];
      ++tally.points;
      for (const auto& ranges : outers) tally.missed += inside && !holds(ranges, id);
      for (const auto& ranges : inners) tally.wrongly_inside += !inside && holds(ranges, id);
    }
  }
  if (tally.faults() > faults_before) tally.where = c.name;
}

constexpr double kRad = M_PI / 180;

/// Poles, antimeridian, octahedron corners and edges, and elsewhere.
std::vector<globe::geo::Geodetic> nasty_places(std::mt19937_64& random) {
  std::vector<globe::geo::Geodetic> places{{90, 0},  {-90, 0},   {0, 0},    {0, 180},       {0, -90},
                                           {45, 45}, {89.99, 7}, {12, 180}, {-35, 179.999}, {0, 33}};
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 4; ++k) places.push_back({std::asin(unit(random)) / kRad, 180 * unit(random)});
  return places;
}

std::vector<dvec3> circle(const dvec3& center, double radius_rad, std::mt19937_64& random) {
  std::vector<dvec3> points;
  for (int k = 0; k < 64; ++k) {
    const dvec3 side = glm::normalize(glm::cross(center, hard::random_direction(random)));
    points.push_back(glm::normalize(std::cos(radius_rad) * center + std::sin(radius_rad) * side));
  }
  return points;
}

void add_cones(std::vector<CoverCase>& cases, std::mt19937_64& random) {
  for (const auto& at : nasty_places(random)) {
    const dvec3 center = normal_from_degrees(at.lat_deg, at.lon_deg);
    for (const double radius_deg :
         {0.0, 1e-8, 1e-3, 0.7, 12.0, 89.999, 90.0, 90.001, 135.0, 179.0, 179.999, 180.0 - 1e-8, 180.0}) {
      const double small = std::min(radius_deg, 180 - radius_deg) * kRad;
      const dvec3 focus = radius_deg > 90 ? -center : center;
      cases.push_back({"cone " + std::to_string(radius_deg), std::make_shared<Cone>(center, radius_deg),
                       focus, std::max(2 * small, 1e-8), circle(focus, small, random)});
    }
  }
}

void add_ellipsoid_cones(std::vector<CoverCase>& cases, std::mt19937_64& random) {
  for (const auto& ellipsoid : {globe::geo::kWgs84, globe::geo::kMars, globe::geo::Ellipsoid{1e6, -0.02}}) {
    for (const auto& at : nasty_places(random)) {
      const dvec3 center = normal_from_degrees(at.lat_deg, at.lon_deg);
      for (const double part : {1e-10, 1e-3, 0.1, 1.5, 3.0, 3.1}) {
        const double radius_m = part * ellipsoid.a;
        std::vector<dvec3> border;
        border.reserve(64);
        const globe::geo::GeodesicCircle points(ellipsoid, at, radius_m);
        for (int k = 0; k < 64; ++k) border.push_back(glm::normalize(points.at(0.1 * k)));
        cases.push_back({"ellipsoid cone " + std::to_string(radius_m),
                         std::make_shared<globe::region::EllipsoidCone>(ellipsoid, at, radius_m), center,
                         std::max(1.5 * std::min(part, 2.0), 1e-8), border});
      }
    }
  }
}

void add_boxes(std::vector<CoverCase>& cases, std::mt19937_64& random) {
  struct Sides {
    double w, s, e, n;
  };
  for (const Sides& b :
       {Sides{-10, 20, 30, 40}, Sides{170, -10, -170, 10}, Sides{0, 80, 90, 90}, Sides{-180, 60, 180, 90},
        Sides{-180, -90, 180, 90}, Sides{20, -90, 20, 90}, Sides{20, 30, 60, 30}, Sides{5, 5, 5, 5},
        Sides{10, -50, 5, 70}, Sides{0, -90, 360, -89}, Sides{1, 1, 1.001, 1.0005}, Sides{100, -90, 280, 0},
        Sides{179.9999, 89.999, -179.9999, 89.9999}}) {
    std::vector<dvec3> border;
    std::uniform_real_distribution<double> unit(0, 1);
    const double width = b.e < b.w ? b.e + 360 - b.w : b.e - b.w;
    for (int k = 0; k < 64; ++k) {
      const double t = unit(random);
      const double lat = k % 2 == 0 ? b.s + t * (b.n - b.s) : k % 4 == 1 ? b.s : b.n;
      const double lon = k % 2 == 1 ? b.w + t * width : k % 4 == 0 ? b.w : b.w + width;
      border.push_back(normal_from_degrees(lat, lon));
    }
    const double size = std::max({b.n - b.s, std::min(width, 180.0), 1e-6}) * kRad;
    cases.push_back({"box " + std::to_string(b.w) + "," + std::to_string(b.s),
                     std::make_shared<globe::region::LatLonBox>(b.w, b.s, b.e, b.n),
                     normal_from_degrees((b.s + b.n) / 2, b.w + width / 2), std::min(size, M_PI), border});
  }
}

/// A star around a place: corners at random distances, in the order of their azimuths.
Polygon::Ring star(const dvec3& center, double radius_rad, int corners, std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0.2, 1.0);
  const dvec3 east =
      glm::normalize(glm::cross(center, std::abs(center.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0)));
  const dvec3 north = glm::cross(center, east);
  Polygon::Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double azimuth = 2 * M_PI * k / corners;
    const double r = radius_rad * part(random);
    ring.push_back(glm::normalize(std::cos(r) * center +
                                  std::sin(r) * (std::cos(azimuth) * east + std::sin(azimuth) * north)));
  }
  return ring;
}

std::vector<dvec3> along(const Polygon::Ring& ring) {
  std::vector<dvec3> points = ring;
  for (std::size_t k = 0; k < ring.size(); ++k)
    points.push_back(glm::normalize(ring[k] + ring[(k + 1) % ring.size()]));
  return points;
}

void add_polygons(std::vector<CoverCase>& cases, std::mt19937_64& random) {
  for (const auto& at : nasty_places(random)) {
    const dvec3 center = normal_from_degrees(at.lat_deg, at.lon_deg);
    for (const double radius_rad : {1e-8, 1e-3, 0.1, 1.2}) {
      Polygon::Ring outer = star(center, radius_rad, 12, random);
      cases.push_back(
          {"star", std::make_shared<Polygon>(Polygon::Rings{outer}), center, 1.2 * radius_rad, along(outer)});
      Polygon::Ring hole = star(center, 0.15 * radius_rad, 7, random);
      Polygon::Rings rings{outer, hole};
      std::vector<dvec3> border = along(outer);
      for (const dvec3& p : along(hole)) border.push_back(p);
      cases.push_back(
          {"star with a hole", std::make_shared<Polygon>(rings), center, 1.2 * radius_rad, border});
      const dvec3 tip = near(random, center, radius_rad);
      const Polygon::Ring needle{
          center, tip, glm::normalize(glm::mix(center, tip, 0.5) + 1e-12 * hard::random_direction(random))};
      cases.push_back({"needle", std::make_shared<Polygon>(Polygon::Rings{needle}), center, 1.2 * radius_rad,
                       along(needle)});
    }
  }
  const globe::htm::Corners own = globe::htm::corners({12345});
  const Polygon::Ring trixel(own.begin(), own.end());
  cases.push_back(
      {"a trixel", std::make_shared<Polygon>(Polygon::Rings{trixel}), own[0], 0.3, along(trixel)});
}

void add_map_polygons(std::vector<CoverCase>& cases, std::mt19937_64&) {
  using Rings = globe::region::MapPolygon::Rings;
  const std::vector<std::vector<Rings>> all{
      {{{{10, 20}, {10, 60}, {50, 70}, {45, 10}}}},
      {{{{60, 0}, {60, 120}, {80, 120}, {80, 0}}, {{65, 10}, {75, 60}, {65, 100}}}},
      {{{{-10, 170}, {-10, 190}, {10, 190}, {15, 170}}}},
      {{{{-20, 170}, {-20, 180}, {-10, 180}, {-10, 170}}},
       {{{-20, -180}, {-20, -170}, {-15, -170}, {-10, -180}}}},
      {{{{60, -180}, {60, 180}, {90, 180}, {90, -180}}}},
      {{{{-90, -180}, {-70, -180}, {-60, -60}, {-75, 60}, {-70, 180}, {-90, 180}}}},
      {{{{0, 0}, {0.0001, 0.0001}, {0.0002, 0}}}},
      {{{{-90, -180}, {-90, 180}, {90, 180}, {90, -180}}}}};
  for (const auto& polygons : all) {
    std::vector<dvec3> border;
    for (const Rings& rings : polygons)
      for (const auto& ring : rings)
        for (std::size_t k = 0; k < ring.size(); ++k)
          for (const double t : {0.0, 0.25, 0.6})
            border.push_back(globe::region::MapLine(ring[k], ring[(k + 1) % ring.size()]).at(t));
    const double size = std::max(glm::distance(border[0], border[4]), glm::distance(border[0], border[7]));
    cases.push_back({"map polygon " + std::to_string(cases.size()),
                     std::make_shared<globe::region::MapPolygon>(polygons), border[0],
                     std::min(3 * size, M_PI), border});
  }
}

TEST(Cover, HoldsThePointsOfTheRegionAndTheInnerOneNoOthers) {
  std::mt19937_64 random(70);
  std::vector<CoverCase> cases;
  add_cones(cases, random);
  add_ellipsoid_cones(cases, random);
  add_boxes(cases, random);
  add_polygons(cases, random);
  add_map_polygons(cases, random);
  const std::size_t plain = cases.size();
  for (std::size_t k = 0; k < plain; k += 3) {
    cases.push_back({"complement of " + cases[k].name,
                     std::make_shared<globe::htm::Complement>(cases[k].region), cases[k].place,
                     cases[k].reach_rad, cases[k].border});
  }
  const std::size_t points = hard::cases(20'000);
  const std::size_t step = hard::full() ? 1 : 2;
  Tally tally;
  for (std::size_t k = 0; k < cases.size(); k += step) try_case(cases[k], random, points, tally);
  hard::report("cover",
               "points of " + std::to_string(cases.size() / step) + " regions outside their covers, " +
                   std::to_string(tally.points) + " tried",
               "0", std::to_string(tally.missed));
  hard::report("cover", "points outside the region in inner covers", "0",
               std::to_string(tally.wrongly_inside));
  hard::report("cover", "covers over their budget", "0", std::to_string(tally.over_budget));
  EXPECT_EQ(tally.missed, 0u) << tally.where;
  EXPECT_EQ(tally.wrongly_inside, 0u) << tally.where;
  EXPECT_EQ(tally.disordered, 0u);
  EXPECT_EQ(tally.over_budget, 0u);
}

/// A region that takes one trixel in four for disjoint, or for inside, when it touches.
class Careless final : public Region {
 public:
  Careless(RegionPointer region, globe::htm::Relation mistake)
      : region_(std::move(region)), mistake_(mistake) {}

  bool contains(const dvec3& u) const override { return region_->contains(u); }
  globe::htm::Relation relation(const globe::htm::Corners& t) const override {
    const auto relation = region_->relation(t);
    const bool slips = std::fmod(std::abs(t[0].x) * 1e6, 1.0) < 0.25;
    return slips && relation == globe::htm::Relation::kTouches ? mistake_ : relation;
  }
  std::vector<dvec3> border_points() const override { return region_->border_points(); }

 private:
  RegionPointer region_;
  globe::htm::Relation mistake_;
};

TEST(Cover, NegativeControlACarelessRelationIsFoundOut) {
  std::mt19937_64 random(71);
  const dvec3 center = normal_from_degrees(48, 16);
  const auto cone = std::make_shared<Cone>(center, 1.0);
  for (const auto mistake : {globe::htm::Relation::kDisjoint, globe::htm::Relation::kInside}) {
    Tally tally;
    try_case({"careless", std::make_shared<Careless>(cone, mistake), center, 2.0 * kRad, {}}, random, 2000,
             tally);
    EXPECT_GT(mistake == globe::htm::Relation::kDisjoint ? tally.missed : tally.wrongly_inside, 0u);
  }
}

}  // namespace
