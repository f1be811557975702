#include "globe/search/csv_features.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "globe/base/error.h"

namespace globe::search {
namespace {

struct Seen {
  std::vector<NewFeature> features;
  std::vector<BadLine> bad;
};

Seen read(const std::string& text, const Columns& columns = {}) {
  std::istringstream stream(text);
  Seen seen;
  visit_csv(
      stream, "test.csv", columns,
      [&](NewFeature&& feature, std::size_t) { seen.features.push_back(std::move(feature)); },
      [&](const BadLine& bad) { seen.bad.push_back(bad); });
  return seen;
}

TEST(CsvFeatures, FindsItsColumnsByTheirUsualNames) {
  for (const char* header :
       {"lat,lon,name", "Latitude,LONGITUDE,Name", "y,x,NAME", "LAT,lng,name", "lat,long,name"}) {
    const Seen seen = read(std::string(header) + "\n48.25,16.5,Wien\n");
    ASSERT_EQ(seen.features.size(), 1u) << header;
    EXPECT_EQ(seen.features[0].geometry.points[0].lat_deg, 48.25);
    EXPECT_EQ(seen.features[0].geometry.points[0].lon_deg, 16.5);
    EXPECT_EQ(seen.features[0].name, "Wien");
    EXPECT_EQ(seen.features[0].properties, "");
  }
}

TEST(CsvFeatures, TakesTheColumnsThatAreNamedOrNumbered) {
  const std::string text = "y,x,phi,lambda,title\n1,2,3,4,five\n";
  EXPECT_EQ(read(text, {"Phi", "LAMBDA", "title"}).features[0].geometry.points[0].lat_deg, 3.0);
  EXPECT_EQ(read(text, {"Phi", "LAMBDA", "title"}).features[0].name, "five");
  const Seen numbered = read("five,3,4\n", {"2", "3", "1"});
  EXPECT_EQ(numbered.features[0].geometry.points[0].lon_deg, 4.0);
  EXPECT_EQ(numbered.features[0].name, "five");
  EXPECT_THROW(read(text, {"phi", "mu", ""}), Error);
  EXPECT_THROW(read("a,b\n1,2\n"), Error);
  EXPECT_THROW(read(""), Error);
  EXPECT_THROW(read("lat,lon,\xff\n1,2,3\n"), Error);
  EXPECT_THROW(read("lat,lon,a\"b\n1,2,3\n"), Error);
}

TEST(CsvFeatures, OtherColumnsArePropertiesAsTheyStand) {
  const Seen seen = read("lat,lon,zip,empty,,zip\n1,2,0123,,c,d\n");
  const auto properties = nlohmann::json::parse(seen.features.at(0).properties);
  EXPECT_EQ(properties, (nlohmann::json{{"zip", "0123"}, {"#5", "c"}, {"zip#6", "d"}}));
}

TEST(CsvFeatures, NamesEveryBadLineAndReadsOn) {
  const Seen seen = read(
      "lat,lon,name\n"
      "1,2,good\n"
      "north,2,a\n"
      "91,2,b\n"
      "1,,c\n"
      "1,nan,d\n"
      "1,2,e,more\n"
      "1,2,\xff\n"
      "1,2,\"open\n"
      "1 2,3,f\n"
      "+1.5e0,1080,good\n");
  std::vector<std::size_t> lines;
  for (const BadLine& bad : seen.bad) lines.push_back(bad.line);
  EXPECT_EQ(lines, (std::vector<std::size_t>{3, 4, 5, 6, 7, 8, 9, 10}));
  ASSERT_EQ(seen.features.size(), 2u);
  EXPECT_EQ(seen.features[1].geometry.points[0].lat_deg, 1.5);
}

}  // namespace
}  // namespace globe::search
