#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/cover.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"
#include "globe/region/map_polygon.h"

namespace globe::region {
namespace {

using geo::normal_from_degrees;
using Rings = MapPolygon::Rings;

bool holds(const htm::Region& region, double lat_deg, double lon_deg) {
  return region.contains(normal_from_degrees(lat_deg, lon_deg));
}

TEST(LatLonBox, HoldsItsSidesAndCornersAndNoMore) {
  const LatLonBox box(10, 20, 30, 40);
  for (const double lat : {20.0, 30.0, 40.0})
    for (const double lon : {10.0, 20.0, 30.0}) EXPECT_TRUE(holds(box, lat, lon));
  constexpr double kBeyond = 1e-11;
  EXPECT_FALSE(holds(box, 20 - kBeyond, 20));
  EXPECT_FALSE(holds(box, 40 + kBeyond, 20));
  EXPECT_FALSE(holds(box, 30, 10 - kBeyond));
  EXPECT_FALSE(holds(box, 30, 30 + kBeyond));
  EXPECT_FALSE(holds(box, -30, -160));
}

TEST(LatLonBox, IsBoundedByParallelsNotGreatCircles) {
  const LatLonBox box(0, 40, 60, 50);
  EXPECT_FALSE(holds(box, 51, 30));  // the great circle from (50, 0) to (50, 60) runs through 53.9
  EXPECT_TRUE(holds(box, 40.5, 30));
}

TEST(LatLonBox, HoldsAPoleThatItReaches) {
  EXPECT_TRUE(holds(LatLonBox(0, 80, 90, 90), 90, 0));
  EXPECT_TRUE(holds(LatLonBox(0, 80, 90, 90), 90, -120));
  EXPECT_FALSE(holds(LatLonBox(0, 80, 90, 90), 89.999, -120));
  // Around a pole without meridians: the trixels there lie inside.
  EXPECT_EQ(LatLonBox(-180, 60, 180, 90).relation(htm::corners(*htm::trixel_from_name("N3100000"))),
            htm::Relation::kInside);
}

TEST(LatLonBox, OfNoWidthOrHeightIsALine) {
  const LatLonBox meridian(20, -90, 20, 90);
  EXPECT_TRUE(holds(meridian, 33, 20));
  EXPECT_FALSE(holds(meridian, 33, 20.0000001));
  EXPECT_FALSE(holds(meridian, 33, -160));
  const LatLonBox parallel(20, 30, 60, 30);
  EXPECT_TRUE(holds(parallel, 30, 40));
  EXPECT_FALSE(htm::cover(parallel, {8, false, 0}).empty());
  EXPECT_TRUE(htm::cover(parallel, {8, true, 0}).empty());
}

TEST(LatLonBox, RefusesWhatIsNone) {
  EXPECT_THROW(LatLonBox(0, 10, 1, 9), UsageError);
  EXPECT_THROW(LatLonBox(0, -91, 1, 9), UsageError);
  EXPECT_THROW(LatLonBox(0, 0, std::nan(""), 9), UsageError);
}

TEST(MapPolygon, EdgesAreStraightOnTheMap) {
  const std::vector<Rings> triangle{{{{0, 0}, {60, 60}, {0, 60}}}};
  const MapPolygon polygon(triangle);
  EXPECT_TRUE(holds(polygon, 29.999, 30));
  EXPECT_TRUE(holds(polygon, 30, 30));
  EXPECT_FALSE(holds(polygon, 30.001, 30));
}

TEST(MapPolygon, HolesAndUnions) {
  const std::vector<Rings> polygons{{{{0, 0}, {0, 10}, {10, 10}, {10, 0}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}}},
                                    {{{5, 5}, {5, 15}, {15, 15}, {15, 5}}}};
  const MapPolygon polygon(polygons);
  EXPECT_FALSE(holds(polygon, 4.5, 4.5));
  EXPECT_TRUE(holds(polygon, 5.5, 5.5));  // the other polygon fills the hole
  EXPECT_TRUE(holds(polygon, 4, 5));
  EXPECT_TRUE(holds(polygon, 12, 12));
}

TEST(MapPolygon, GoesOnAcrossTheAntimeridian) {
  const std::vector<Rings> across{{{{-10, 170}, {-10, 190}, {10, 190}, {10, 170}}}};
  for (const double lon : {170.0, 175.0, 180.0, -180.0, -175.0, -170.0})
    EXPECT_TRUE(holds(MapPolygon(across), 0, lon));
  EXPECT_FALSE(holds(MapPolygon(across), 0, 0));
  const std::vector<Rings> through_greenwich{{{{-10, 170}, {-10, -170}, {10, -170}, {10, 170}}}};
  EXPECT_TRUE(holds(MapPolygon(through_greenwich), 0, 0));
  EXPECT_FALSE(holds(MapPolygon(through_greenwich), 0, 180));
}

TEST(MapPolygon, CutAtTheAntimeridianItHasNoBorderThere) {
  const std::vector<Rings> whole{{{{-10, 160}, {-10, 200}, {10, 200}, {10, 160}}}};
  const std::vector<Rings> cut{{{{-10, 160}, {-10, 180}, {10, 180}, {10, 160}}},
                               {{{-10, -180}, {-10, -160}, {10, -160}, {10, -180}}}};
  for (const bool inner : {false, true})
    EXPECT_EQ(htm::cover(MapPolygon(whole), {8, inner, 0}), htm::cover(MapPolygon(cut), {8, inner, 0}));
}

TEST(MapPolygon, OfTheWholeMapIsTheSphere) {
  const std::vector<Rings> map{{{{-90, -180}, {-90, 180}, {90, 180}, {90, -180}}}};
  const auto ranges = htm::cover(MapPolygon(map), {6, true, 0});
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].first, 8u << 12);
  EXPECT_EQ(ranges[0].last, (16u << 12) - 1);
}

TEST(MapPolygon, RefusalsNameTheEdges) {
  const std::vector<Rings> bow{{{{0, 0}, {10, 10}, {0, 10}, {10, 0}}}};
  try {
    const MapPolygon polygon(bow);
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("corner 1 crosses the edge from corner 3"), std::string::npos);
  }
  EXPECT_THROW(MapPolygon(std::vector<Rings>{{{{0, 0}, {10, 10}}}}), UsageError);
  EXPECT_THROW(MapPolygon(std::vector<Rings>{}), UsageError);
}

TEST(EllipsoidCone, BorderIsTheGeodesicDistance) {
  // Ten degrees of a meridian from the equator: GeodSolve, WGS84, 1105854.833 m.
  const EllipsoidCone cone(geo::kWgs84, {0, 20}, 1105854.834);
  EXPECT_TRUE(holds(cone, 10, 20));
  EXPECT_FALSE(holds(cone, 10.00000002, 20));
  // A sphere's cone of ten degrees reaches as far along the equator; the ellipsoid's does not.
  EXPECT_FALSE(holds(cone, 0, 30));
}

TEST(EllipsoidCone, WiderThanThePlanetIsAllOfIt) {
  const EllipsoidCone cone(geo::kWgs84, {12, 34}, 20003932.0);
  EXPECT_TRUE(holds(cone, -12, -146));
  EXPECT_EQ(htm::cover(cone, {10, true, 0}).size(), 1u);
}

TEST(EllipsoidCone, AtItsWidestHoldsAllButTheAntipode) {
  const EllipsoidCone cone(geo::kWgs84, {0, 0}, 19990e3);
  EXPECT_FALSE(holds(cone, 0, 180));
  EXPECT_TRUE(holds(cone, 1, 180));
  EXPECT_GT(htm::cover(cone, {12, true, 0}).size(), 1u);
}

}  // namespace
}  // namespace globe::region
