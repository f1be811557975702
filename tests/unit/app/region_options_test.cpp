#include "app/region_options.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "globe/base/error.h"
#include "globe/htm/cover.h"
#include "tests/temporary_folder.h"

namespace app {
namespace {

using globe::htm::IdRange;

std::vector<IdRange> cone(const std::string& text) {
  RegionOptions options;
  options.cone = text;
  return globe::htm::cover(*make_region(options), {9, false, 0});
}

std::vector<IdRange> polygon(const std::string& text, const std::string& edges = "great-circle") {
  RegionOptions options;
  options.polygon = text;
  options.edges = edges;
  return globe::htm::cover(*make_region(options), {6, false, 0});
}

std::vector<IdRange> box(const std::string& text) {
  RegionOptions options;
  options.box = text;
  return globe::htm::cover(*make_region(options), {6, false, 0});
}

TEST(RegionOptions, ARadiusComesInEveryUnit) {
  const auto metres = cone("10,20,185200m");
  for (const char* same :
       {"10,20,185200", "10,20,185.2km", "10,20,100nmi", "10 20 100 nmi", "10N,20E,185.2 km",
        " 10 , 20 , 185.2km ", "20E 10N 185.2km", "10d0'0\"N 20d0'0\"E 185.2km"})
    EXPECT_EQ(cone(same), metres) << same;
  for (const char* same : {"10,20,90arcmin", "10,20,5400 arcsec", "10 20 1.5 deg"})
    EXPECT_EQ(cone(same), cone("10,20,1.5deg")) << same;
}

TEST(RegionOptions, ARadiusInMetresIsNotOneInDegrees) {
  // 1.5 degrees of the mean meridian: the ellipsoid's cone differs from the sphere's.
  EXPECT_NE(cone("10,20,166.8km"), cone("10,20,1.5deg"));
}

TEST(RegionOptions, OnASphereBothRadiiAreTheSame) {
  RegionOptions length, angle;
  length.cone = "10,20,1km";
  angle.cone = "10,20,57.29577951308232deg";
  const globe::geo::Ellipsoid sphere{1000.0, 0.0};
  EXPECT_EQ(globe::htm::cover(*make_region(length, sphere), {8, false, 0}),
            globe::htm::cover(*make_region(angle, sphere), {8, false, 0}));
}

TEST(RegionOptions, CornersComeInEveryForm) {
  const auto square = polygon("0,0 0,10 10,10 10,0");
  for (const char* same : {"0 0; 0 10; 10 10; 10 0", "0N,0E 0N,10E 10N,10E 10N,0E",
                           "0,0\n0,10\n10,10\n10,0\n0,0", "0N 0E;0N 10E;10N 10E;10N 0E;"})
    EXPECT_EQ(polygon(same), square) << same;
}

TEST(RegionOptions, TheComplementIsTheOther) {
  RegionOptions options;
  options.cone = "10,20,5deg";
  options.complement = true;
  EXPECT_FALSE(make_region(options)->contains({0.925, 0.337, 0.174}));
  EXPECT_TRUE(make_region(options)->contains({0, 0, 1}));
}

TEST(RegionOptions, AFileMayHoldManyPolygonsAndOtherThings) {
  const tests::TemporaryFolder folder;
  const std::string path = (folder.path() / "mixed.geojson").string();
  std::ofstream(path) << R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}},
    {"type":"Feature","properties":{},"geometry":null},
    {"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[
      [[[0,0],[10,0],[10,10],[0,10],[0,0]]], [[[20,0],[30,0],[30,10],[20,10],[20,0]]]]}}]})";
  EXPECT_GT(polygon(path).size(), polygon("0,0 0,10 10,10 10,0").size());
  EXPECT_FALSE(polygon(path, "map").empty());
}

TEST(RegionOptions, WhatCannotBeUnderstoodIsAUsageError) {
  for (const char* bad : {"1,2", "km", ",,,", "1,2,x", "1,2,", "1,2,-5km", "1,2,181deg", "1,2,nan", "1,2,inf",
                          "1,2,3parsec", "91,2,3km", "1,2,1e999", " ", "3km", "a,b,3km"})
    EXPECT_THROW(cone(bad), globe::UsageError) << bad;
  for (const char* bad :
       {"1,2,3", "1,2,3,4,5", "1,20,3,10", "1,2,3,91", "1,2,inf,4", "a,b,c,d", "1,,2,3", ",", " "})
    EXPECT_THROW(box(bad), globe::UsageError) << bad;
  for (const char* edges : {"great-circle", "map"})
    for (const char* bad : {"0,0 1,1", "0,0", " ", "0,0 10,10 0,10 10,0", "0,0 0,10 x,y", "0,0 0,10 91,0",
                            "0,0 0,10 nan,0", "0,0 1,1 0,0 1,1", "1 2 3", "0,0,0,0 1,1 2,2"})
      EXPECT_THROW(polygon(bad, edges), globe::UsageError) << edges << ": " << bad;
}

TEST(RegionOptions, AFileThatIsNoneIsAnError) {
  for (const char* bad : {"missing.geojson", "missing.JSON", "/tmp"})
    EXPECT_THROW(polygon(bad), globe::Error) << bad;
}

}  // namespace
}  // namespace app
