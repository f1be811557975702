#include "globe/geo/geojson.h"

#include <gtest/gtest.h>

#include <sstream>

#include "globe/base/error.h"

namespace globe::geo {
namespace {

std::vector<Feature> read(const std::string& text) {
  std::istringstream stream(text);
  std::vector<Feature> features;
  visit_geojson(stream, "test", [&](Feature&& feature) { features.push_back(std::move(feature)); });
  return features;
}

std::string message(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string geometry(const std::string& type, const std::string& coordinates) {
  return R"({"type":")" + type + R"(","coordinates":)" + coordinates + "}";
}

TEST(GeoJson, ReadsEveryTypeOfGeometry) {
  const Geometry point = read(geometry("Point", "[16.5,48.25,171.5]"))[0].geometry;
  EXPECT_EQ(point.points[0].lat_deg, 48.25);
  EXPECT_EQ(point.points[0].lon_deg, 16.5);
  EXPECT_EQ(point.points[0].h_m, 171.5);
  EXPECT_EQ(read(geometry("MultiPoint", "[[1,2],[3,4]]"))[0].geometry.points.size(), 2u);
  EXPECT_EQ(read(geometry("LineString", "[[1,2],[3,4]]"))[0].geometry.lines[0].size(), 2u);
  EXPECT_EQ(
      read(geometry("MultiLineString", "[[[1,2],[3,4]],[[1,2],[3,4],[5,6]]]"))[0].geometry.lines[1].size(),
      3u);
  const Geometry polygon =
      read(geometry("Polygon", "[[[0,0],[9,0],[9,9],[0,0]],[[1,1],[2,1],[2,2],[1,1]]]"))[0].geometry;
  ASSERT_EQ(polygon.polygons.size(), 1u);
  EXPECT_EQ(polygon.polygons[0].size(), 2u);
  EXPECT_EQ(polygon.polygons[0][0].size(), 3u);  // without the repeated point
  EXPECT_EQ(read(geometry("MultiPolygon", "[[[[0,0],[9,0],[9,9],[0,0]]],[[[0,0],[9,0],[9,9],[0,0]]]]"))[0]
                .geometry.polygons.size(),
            2u);
  const Geometry both = read(R"({"type":"GeometryCollection","geometries":[)" + geometry("Point", "[1,2]") +
                             "," + geometry("LineString", "[[1,2],[3,4]]") + "]}")[0]
                            .geometry;
  EXPECT_EQ(both.points.size() + both.lines.size(), 2u);
}

TEST(GeoJson, ReadsACollectionFeatureByFeature) {
  const auto features =
      read(R"({"features":[
    {"type":"Feature","id":7,"properties":{"name":"Wien","capital":true},"geometry":)" +
           geometry("Point", "[16,48]") + R"(},
    {"type":"Feature","properties":null,"geometry":null},
    {"type":"Feature","id":"x","properties":{"features":[{"type":"Feature"}]},"geometry":)" +
           geometry("Point", "[]") + R"(}], "bbox":[1,2,3,4], "type":"FeatureCollection"})");
  ASSERT_EQ(features.size(), 3u);
  EXPECT_EQ(features[0].id, 7);
  EXPECT_EQ(features[0].properties["name"], "Wien");
  EXPECT_EQ(features[0].number, 1u);
  EXPECT_TRUE(features[1].geometry.empty());
  EXPECT_TRUE(features[1].properties.is_null());
  EXPECT_TRUE(features[2].geometry.empty());
  EXPECT_EQ(features[2].number, 3u);
}

TEST(GeoJson, LongitudesAreAsWritten) {
  EXPECT_EQ(read(geometry("LineString", "[[170,0],[190,0]]"))[0].geometry.lines[0][1].lon_deg, 190.0);
}

TEST(GeoJson, RefusesWithTheFeatureAndTheReason) {
  const std::string good =
      R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}})";
  const std::string bad =
      R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,91]}})";
  const std::string seen = message(R"({"type":"FeatureCollection","features":[)" + good + "," + bad + "]}");
  EXPECT_NE(seen.find("test, feature 2"), std::string::npos) << seen;
  EXPECT_NE(seen.find("91"), std::string::npos) << seen;
  for (const std::string& text : {std::string(""),
                                  std::string("{"),
                                  std::string("[]"),
                                  std::string("3"),
                                  std::string("{}"),
                                  std::string(R"({"type":5})"),
                                  std::string(R"({"type":"FeatureCollection"})"),
                                  std::string(R"({"type":"FeatureCollection","features":{}})"),
                                  std::string(R"({"type":"FeatureCollection","features":[3]})"),
                                  geometry("Cube", "[1,2]"),
                                  geometry("Point", "[1]"),
                                  geometry("Point", "[1,\"2\"]"),
                                  geometry("Point", "3"),
                                  geometry("Point", "[1e999,2]"),
                                  geometry("LineString", "[[1,2]]"),
                                  geometry("LineString", "[1,2]"),
                                  geometry("Polygon", "[[[0,0],[1,0],[0,0]]]"),
                                  geometry("Polygon", "[[[0,0],[1,0],[1,1],[0,1]]]"),
                                  std::string(R"({"type":"Point"})"),
                                  std::string(R"({"type":"GeometryCollection","geometries":3})"),
                                  geometry("Point", "[1,2]") + "x"})
    EXPECT_NE(message(text), "") << text;
}

TEST(GeoJson, RefusesCollectionsNestedWithoutEnd) {
  std::string text;
  for (int k = 0; k < 100; ++k) text += R"({"type":"GeometryCollection","geometries":[)";
  for (int k = 0; k < 100; ++k) text += "]}";
  EXPECT_NE(message(text).find("nested"), std::string::npos);
}

TEST(GeoJson, RefusesAFileThatIsNone) {
  EXPECT_THROW(visit_geojson(std::filesystem::path("/nonexistent"), [](Feature&&) {}), Error);
  EXPECT_THROW(visit_geojson(std::filesystem::path("/tmp"), [](Feature&&) {}), Error);
}

}  // namespace
}  // namespace globe::geo
