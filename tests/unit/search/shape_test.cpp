#include "globe/search/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "globe/geo/geodesic_circle.h"
#include "globe/htm/complement.h"
#include "globe/htm/cone.h"
#include "globe/htm/polygon.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"
#include "globe/region/map_polygon.h"
#include "globe/search/region_touch.h"
#include "globe/search/wkb.h"
#include "tests/hard/directions.h"

namespace globe::search {
namespace {

using geo::Geodetic;
using geo::Geometry;
using geo::normal_from_degrees;
using hard::random_direction;
using htm::dvec3;

const GeographicLib::Geodesic kGeodesic(geo::kWgs84.a, geo::kWgs84.f);

Geometry line(std::vector<Geodetic> places) {
  Geometry geometry;
  geometry.lines.push_back(std::move(places));
  return geometry;
}

Geometry polygon(Geometry::Rings rings) {
  Geometry geometry;
  geometry.polygons.push_back(std::move(rings));
  return geometry;
}

const Geometry kSquare = polygon({{{0, 0}, {0, 10}, {10, 10}, {10, 0}}});
const Geometry kSquareWithHole =
    polygon({{{0, 0}, {0, 10}, {10, 10}, {10, 0}}, {{3, 3}, {3, 7}, {7, 7}, {7, 3}}});

bool touches(const Geometry& geometry, const htm::Region& region) { return Shape(geometry).touches(region); }

htm::Cone cone(double lat_deg, double lon_deg, double radius_deg) {
  return {normal_from_degrees(lat_deg, lon_deg), radius_deg};
}

/// The least angle between u and a place of the arc.
double angle_to_arc(const dvec3& u, const dvec3& a, const dvec3& b) {
  const auto angle = [](const dvec3& p, const dvec3& q) {
    return 2.0 * std::atan2(glm::length(p - q), glm::length(p + q));
  };
  const dvec3 normal = glm::normalize(glm::cross(a + b, b - a));
  const dvec3 foot = u - glm::dot(u, normal) * normal;
  const bool between =
      glm::dot(glm::cross(a, foot), normal) >= 0.0 && glm::dot(glm::cross(foot, b), normal) >= 0.0;
  return between ? std::abs(std::asin(glm::dot(u, normal))) : std::min(angle(u, a), angle(u, b));
}

TEST(RegionTouch, AnArcTouchesAConeExactlyWhenItComesAsNear) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 3000; ++k) {
    const dvec3 a = random_direction(random);
    const double length = std::pow(10.0, -7.0 + 7.3 * unit(random));
    const dvec3 b = glm::normalize(a + length * random_direction(random));
    const dvec3 center =
        glm::normalize(a + std::pow(10.0, -7.0 + 7.3 * unit(random)) * random_direction(random));
    const double distance = angle_to_arc(center, a, b);
    constexpr double kAside = 2e-12;
    for (const double side : {-kAside, kAside}) {
      const double radius = distance + side;
      if (radius < 0.0) continue;
      EXPECT_EQ(search::touches(htm::Cone(center, radius / kDegree), a, b), side > 0.0)
          << k << ": length " << length << ", distance " << distance;
    }
  }
}

TEST(RegionTouch, AnArcAsksForItsHighestPlaceOnly) {
  const dvec3 a = normal_from_degrees(50, 0), b = normal_from_degrees(50, 60);
  const double top = std::atan(std::tan(50 * kDegree) / std::cos(30 * kDegree)) / kDegree;
  constexpr double kAside_deg = 1e-10;
  EXPECT_TRUE(search::touches(region::LatLonBox(10, top - kAside_deg, 50, 60), a, b));
  EXPECT_FALSE(search::touches(region::LatLonBox(10, top + kAside_deg, 50, 60), a, b));
  EXPECT_FALSE(search::touches(region::LatLonBox(0, 40, 60, 50 - kAside_deg), a, b));
}

TEST(RegionTouch, DecidesBesideParallelAndSharedEdges) {
  // A polygon's edge along the equator; arcs along it, on it and beside it.
  const htm::Polygon region(htm::Polygon::Rings{
      {normal_from_degrees(0, 0), normal_from_degrees(0, 20), normal_from_degrees(10, 10)}});
  const auto along = [&](double lat, double west, double east) {
    return search::touches(region, normal_from_degrees(lat, west), normal_from_degrees(lat, east));
  };
  EXPECT_TRUE(along(0, 5, 15));
  EXPECT_TRUE(along(0, -5, 25));
  EXPECT_TRUE(along(0, 20, 30));
  EXPECT_FALSE(along(0, 20.0000001, 30));
  EXPECT_FALSE(along(-1e-10, -5, 25));
  EXPECT_FALSE(along(0, -10, -1e-9));
  EXPECT_FALSE(along(0, 175, -175));
}

TEST(Shape, TouchesWhatItsInsideOrItsEdgesMeet) {
  EXPECT_TRUE(touches(kSquare, cone(5, 5, 0.1)));   // the region inside the polygon
  EXPECT_TRUE(touches(kSquare, cone(5, 5, 60)));    // the polygon inside the region
  EXPECT_TRUE(touches(kSquare, cone(-1, 5, 1.5)));  // across an edge, no corner in it
  EXPECT_FALSE(touches(kSquare, cone(-1, 5, 0.999)));
  EXPECT_FALSE(touches(kSquareWithHole, cone(5, 5, 1)));  // in the hole
  EXPECT_TRUE(touches(kSquareWithHole, cone(5, 5, 2.5)));
  EXPECT_TRUE(touches(kSquareWithHole, cone(1, 1, 0.1)));
  const Geometry road = line({{0, 0}, {0, 10}});
  EXPECT_TRUE(touches(road, cone(1, 5, 1.0001)));
  EXPECT_FALSE(touches(road, cone(1, 5, 0.9999)));
}

TEST(Shape, MeetsEveryKindOfRegionAndTheirComplements) {
  const auto complement_of = [](auto region) {
    return htm::Complement(std::make_shared<decltype(region)>(std::move(region)));
  };
  const std::vector<region::MapPolygon::Rings> map{{{{2, 2}, {2, 4}, {4, 4}, {4, 2}}}};
  EXPECT_TRUE(touches(kSquare, region::LatLonBox(2, 2, 4, 4)));
  EXPECT_TRUE(touches(kSquare, region::MapPolygon(map)));
  EXPECT_TRUE(touches(kSquare, region::EllipsoidCone(geo::kWgs84, {5, 5}, 1000)));
  EXPECT_TRUE(
      touches(kSquare, htm::Polygon(htm::Polygon::Rings{{normal_from_degrees(2, 2), normal_from_degrees(2, 4),
                                                         normal_from_degrees(4, 3)}})));
  EXPECT_FALSE(touches(kSquareWithHole, region::LatLonBox(4, 4, 6, 6)));
  // A hole of the region in the polygon.
  EXPECT_TRUE(touches(kSquare, complement_of(cone(5, 5, 0.1))));
  EXPECT_TRUE(touches(kSquareWithHole, complement_of(cone(5, 5, 1))));
  EXPECT_FALSE(touches(kSquare, complement_of(cone(5, 5, 20))));
  EXPECT_FALSE(touches(kSquare, complement_of(region::LatLonBox(-1, -1, 11, 11))));
  // Nothing but a little by the antipode is outside.
  EXPECT_TRUE(touches(kSquare, region::EllipsoidCone(geo::kWgs84, {-5, -175}, 19990e3)));
  EXPECT_TRUE(touches(kSquare, complement_of(region::EllipsoidCone(geo::kWgs84, {-5, -175}, 19990e3))));
  EXPECT_FALSE(touches(kSquare, complement_of(region::EllipsoidCone(geo::kWgs84, {5, 5}, 19990e3))));
  EXPECT_FALSE(touches(kSquare, complement_of(cone(0, 0, 180))));
}

TEST(Shape, HoldsThePoleAndCrossesTheAntimeridian) {
  const Geometry cap = polygon({{{80, 0}, {80, 90}, {80, 180}, {80, -90}}});
  EXPECT_TRUE(touches(cap, cone(90, 0, 0)));
  EXPECT_EQ(Shape(cap).nearest(kGeodesic, {90, 12, 0}).distance_m, 0.0);
  const Geometry strait = line({{0, 179}, {0, -179}});
  EXPECT_TRUE(touches(strait, cone(0.5, 180, 0.6)));
  EXPECT_NEAR(Shape(strait).nearest(kGeodesic, {1, 180, 0}).distance_m,
              geo::geodesic_distance_m(geo::kWgs84, {1, 180, 0}, {0, 180, 0}), 1e-7);
}

/// The nearest place by looking at many of every edge, then around the best of them.
double nearest_by_looking_m(const Geometry& geometry, const Geodetic& from) {
  double best_m = 1e300;
  const auto look = [&](const dvec3& a, const dvec3& b) {
    constexpr int kSteps = 400;
    const auto distance_m = [&](double t) {
      return geo::geodesic_distance_m(geo::kWgs84, from,
                                      geo::degrees_from_normal(glm::normalize((1 - t) * a + t * b)));
    };
    int at = 0;
    double least = distance_m(0);
    for (int k = 1; k <= kSteps; ++k) {
      const double m = distance_m(static_cast<double>(k) / kSteps);
      if (m < least) {
        least = m;
        at = k;
      }
    }
    double low = std::max(0, at - 1) / static_cast<double>(kSteps),
           high = std::min(kSteps, at + 1) / static_cast<double>(kSteps);
    for (int k = 0; k < 100; ++k) {
      const double p = low + (high - low) / 3.0, q = high - (high - low) / 3.0;
      if (distance_m(p) < distance_m(q)) {
        high = q;
      } else {
        low = p;
      }
    }
    best_m = std::min({best_m, least, distance_m(0.5 * (low + high))});
  };
  for (const Geometry::Line& places : geometry.lines) {
    for (std::size_t k = 1; k < places.size(); ++k) {
      look(normal_from_degrees(places[k - 1].lat_deg, places[k - 1].lon_deg),
           normal_from_degrees(places[k].lat_deg, places[k].lon_deg));
    }
  }
  return best_m;
}

TEST(Shape, TheNearestPlaceOfALineIsFound) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0;
  for (int k = 0; k < 120; ++k) {
    const double size = std::pow(10.0, -5.0 + 5.0 * unit(random));
    std::vector<Geodetic> places;
    dvec3 u = random_direction(random);
    if (k % 10 == 0) u = {0, 0, 1};
    if (k % 10 == 1) u = {-1, 0, 0};
    for (int n = 0; n < 3; ++n) {
      places.push_back(geo::degrees_from_normal(u));
      u = glm::normalize(u + size * random_direction(random));
    }
    dvec3 from = glm::normalize(u + std::pow(10.0, -5.0 + 5.0 * unit(random)) * random_direction(random));
    if (k % 10 == 2) from = random_direction(random);
    const Geometry geometry = line(places);
    const Geodetic at = geo::degrees_from_normal(from);
    const Nearest nearest = Shape(geometry).nearest(kGeodesic, at);
    worst = std::max(worst, std::abs(nearest.distance_m - nearest_by_looking_m(geometry, at)));
    EXPECT_LE(nearest.distance_m, nearest_by_looking_m(geometry, at) + 1e-7) << k;
    EXPECT_EQ(nearest.distance_m, geo::geodesic_distance_m(geo::kWgs84, at, nearest.at)) << k;
  }
  EXPECT_LT(worst, 1e-4);  // what a look at 400 places leaves
}

TEST(Shape, OfOnePlaceIsAPoint) {
  Geometry still = line({{10, 20}, {10, 20}});
  EXPECT_EQ(Shape(still).nearest(kGeodesic, {10, 21, 0}).distance_m,
            geo::geodesic_distance_m(geo::kWgs84, {10, 21, 0}, {10, 20, 0}));
  EXPECT_TRUE(touches(still, cone(10, 20, 0)));
  EXPECT_FALSE(Shape(still).cover().empty());
}

TEST(Shape, ItsCoverHoldsItAndIsSmall) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Geometry& geometry :
       {kSquare, kSquareWithHole, line({{0, 0}, {0.001, 0.001}, {50, 50}}), line({{89, 0}, {89, 180}})}) {
    const std::vector<htm::Trixel> cover = Shape(geometry).cover();
    EXPECT_LE(cover.size(), Shape::kCover + 1);
    EXPECT_GT(cover.size(), 10u);
    const auto& places = geometry.lines.empty() ? geometry.polygons[0][0] : geometry.lines[0];
    for (int k = 0; k < 200; ++k) {
      const std::size_t edge = random() % (places.size() - 1);
      const double t = unit(random);
      const dvec3 u =
          glm::normalize((1 - t) * normal_from_degrees(places[edge].lat_deg, places[edge].lon_deg) +
                         t * normal_from_degrees(places[edge + 1].lat_deg, places[edge + 1].lon_deg));
      EXPECT_TRUE(std::any_of(cover.begin(), cover.end(), [&](htm::Trixel trixel) {
        return htm::trixel_at(u, htm::level(trixel)) == trixel;
      })) << k;
    }
  }
}

TEST(Shape, RefusesWhatIsNone) {
  EXPECT_THROW(Shape(polygon({{{0, 0}, {10, 10}, {0, 10}, {10, 0}}})), UsageError);
  EXPECT_THROW(Shape(polygon({{{0, 0}, {0, 0}, {1, 1}}})), UsageError);
  EXPECT_THROW(Shape(line({{0, 0}, {0, 180}})), UsageError);
}

TEST(WellKnownBinary, GivesBackWhatWasPutIn) {
  Geometry geometry = kSquareWithHole;
  geometry.points = {{1, 2}, {-90, 190}};
  geometry.lines = {{{1, 2}, {3, 4}}};
  const auto back = from_wkb(to_wkb(geometry));
  ASSERT_TRUE(back);
  EXPECT_EQ(to_wkb(*back), to_wkb(geometry));
  EXPECT_EQ(back->points[1].lon_deg, 190.0);
  EXPECT_EQ(back->polygons[0][1].size(), 4u);
}

TEST(WellKnownBinary, RefusesEveryPrefixAndOtherBytes) {
  const std::string bytes = to_wkb(kSquareWithHole);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(from_wkb(bytes.substr(0, size))) << size;
  EXPECT_FALSE(from_wkb(bytes + "x"));
  std::string huge = bytes;
  huge[8] = '\x7f';  // a count of two thousand million
  EXPECT_FALSE(from_wkb(huge));
}

}  // namespace
}  // namespace globe::search
