#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

Outcome cover(std::vector<std::string> words) {
  words.insert(words.begin(), "cover");
  return run_program(words);
}

std::string file(const tests::TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const std::string path = (folder.path() / name).string();
  std::ofstream(path) << text;
  return path;
}

TEST(CoverCommand, WritesRisingRangesThatDoNotMeet) {
  const Outcome run = cover({"--cone", "48.2,16.37,50km", "--level", "12"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  std::uint64_t before = 0;
  for (const std::string& line : run.lines()) {
    std::istringstream words(line);
    std::uint64_t first = 0, last = 0;
    ASSERT_TRUE(words >> first >> last) << line;
    EXPECT_GT(first, before + 1);
    EXPECT_LE(first, last);
    before = last;
  }
  EXPECT_GT(run.lines().size(), 20u);
}

TEST(CoverCommand, AnswersAllKeysOfTheContract) {
  for (const std::string& line : cover({"--cone", "48.2,16.37,50km", "--level", "8", "--json"}).lines()) {
    const json answer = json::parse(line);
    EXPECT_EQ(answer["level"], 8);
    EXPECT_TRUE(answer["first"].is_number_integer() && answer["last"].is_number_integer());
    EXPECT_TRUE(answer["inside"].is_boolean());
    const auto name = answer["first_name"].get<std::string>();
    EXPECT_EQ(json::parse(run_program({"trixel", "--json", name}).out)["id"], answer["first"]);
  }
}

TEST(CoverCommand, HoldsTheIdOfTheCentre) {
  const auto line = run_program({"lookup", "--json", "--level", "15", "-33.45,-70.67"}).out;
  const auto id = json::parse(line)["id"].get<std::uint64_t>();
  bool found = false;
  for (const std::string& range : cover({"--cone=-33.45,-70.67,1km", "--level", "15", "--json"}).lines()) {
    const json answer = json::parse(range);
    found = found || (answer["first"] <= id && id <= answer["last"]);
  }
  EXPECT_TRUE(found);
}

TEST(CoverCommand, KeepsToTheBudget) {
  for (const int budget : {1, 8, 33}) {
    for (const bool inner : {false, true}) {
      std::vector<std::string> words{"--box", "5,45,10,47",   "--level",
                                     "14",    "--max-ranges", std::to_string(budget)};
      if (inner) words.push_back("--inner");
      EXPECT_EQ(cover(words).lines().size(), static_cast<std::size_t>(budget));
    }
  }
}

TEST(CoverCommand, TakesARadiusInEveryUnit) {
  const std::string metres = cover({"--cone", "10,20,185200m", "--level", "9"}).out;
  for (const char* same : {"10,20,185200", "10N 20E 100 nmi"})
    EXPECT_EQ(cover({"--cone", same, "--level", "9"}).out, metres) << same;
  EXPECT_NE(cover({"--cone", "10,20,100arcmin", "--level", "9"}).out, metres);
}

TEST(CoverCommand, MeasuresLengthsOnTheEllipsoidGiven) {
  const std::vector<std::string> words{"--cone", "10,20,100km", "--level", "10"};
  auto moon = words;
  moon.insert(moon.end(), {"--ellipsoid", "moon"});
  EXPECT_GT(cover(moon).lines().size(), 2 * cover(words).lines().size());
}

TEST(CoverCommand, PolygonIsTheSameEitherWayAroundAndFromAFile) {
  const tests::TemporaryFolder folder;
  const std::string text = cover({"--polygon", "0,0 0,10 10,10 10,0", "--level", "7"}).out;
  EXPECT_EQ(cover({"--polygon", "10,0 10,10 0,10 0,0", "--level", "7"}).out, text);
  EXPECT_EQ(cover({"--polygon", "0N 0E; 0 10; 10,10; 10 0; 0 0", "--level", "7"}).out, text);
  const std::string ring = R"({"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]})";
  EXPECT_EQ(cover({"--polygon", file(folder, "a.geojson", ring), "--level", "7"}).out, text);
  const std::string feature = R"({"type":"Feature","properties":{"a":1},"geometry":)" + ring + "}";
  EXPECT_EQ(cover({"--polygon", file(folder, "b.json", feature), "--level", "7"}).out, text);
  const std::string both = R"({"type":"FeatureCollection","features":[)" + feature + "," + feature + "]}";
  EXPECT_EQ(cover({"--polygon", file(folder, "c.GeoJSON", both), "--level", "7"}).out, text);
}

TEST(CoverCommand, EdgesOfAMapAreNotGreatCircles) {
  const std::vector<std::string> words{"--polygon", "50,0 50,60 40,60 40,0", "--level", "9"};
  auto map = words;
  map.insert(map.end(), {"--edges", "map"});
  auto box = std::vector<std::string>{"--box", "0,40,60,50", "--level", "9"};
  EXPECT_NE(cover(map).out, cover(words).out);
  EXPECT_EQ(cover(map).out, cover(box).out);
}

TEST(CoverCommand, BoxesRunAcrossTheAntimeridian) {
  const std::string across = cover({"--box", "170,-10,-170,10", "--level", "6"}).out;
  EXPECT_EQ(cover({"--box", "170,-10,190,10", "--level", "6"}).out, across);
  EXPECT_EQ(cover({"--box=-190,-10,-170,10", "--level", "6"}).out, across);
  EXPECT_EQ(cover({"--polygon", "-10,170 -10,190 10,190 10,170", "--edges", "map", "--level", "6"}).out,
            across);
}

TEST(CoverCommand, ComplementIsTheRest) {
  std::uint64_t count = 0;
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--box", "0,0,20,20", "--level", "5", "--json"},
        std::vector<std::string>{"--box", "0,0,20,20", "--level", "5", "--json", "--complement",
                                 "--inner"}}) {
    for (const std::string& line : cover(words).lines()) {
      const json range = json::parse(line);
      count += range["last"].get<std::uint64_t>() - range["first"].get<std::uint64_t>() + 1;
    }
  }
  EXPECT_EQ(count, 8u << 10);
}

/// Twice the area on the map, positive when counter-clockwise.
double doubled_area(const json& ring) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k)
    sum += ring[k][0].get<double>() * ring[k + 1][1].get<double>() -
           ring[k + 1][0].get<double>() * ring[k][1].get<double>();
  return sum;
}

TEST(CoverCommand, GeoJsonKeepsTheRulesOfRfc7946) {
  for (const char* region : {"--box=170,-10,-170,10", "--cone=90,0,30deg", "--cone=-90,0,30deg",
                             "--cone=0,180,500km", "--cone=0,0,180deg"}) {
    const Outcome run = cover({region, "--level", "5", "--geojson"});
    EXPECT_EQ(run.status, 0) << run.err;
    const json collection = json::parse(run.out);
    EXPECT_EQ(collection["type"], "FeatureCollection");
    ASSERT_FALSE(collection["features"].empty());
    double area = 0;
    for (const json& feature : collection["features"]) {
      EXPECT_EQ(feature["type"], "Feature");
      ASSERT_EQ(feature["geometry"]["type"], "Polygon");
      const json& ring = feature["geometry"]["coordinates"][0];
      ASSERT_GE(ring.size(), 4u);
      EXPECT_EQ(ring.front(), ring.back());
      EXPECT_GT(doubled_area(ring), 0.0) << ring;
      area += 0.5 * doubled_area(ring);
      for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
        EXPECT_LE(std::abs(ring[k][0].get<double>()), 180.0);
        EXPECT_LE(std::abs(ring[k][0].get<double>() - ring[k + 1][0].get<double>()), 90.0);
      }
    }
    if (std::string(region) == "--cone=0,0,180deg") {
      EXPECT_NEAR(area, 360.0 * 180.0, 1e-6);
    }
  }
}

TEST(CoverCommand, GeoJsonOfNothingIsAnEmptyCollection) {
  const Outcome run = cover({"--cone", "0,0,1m", "--level", "5", "--inner", "--geojson"});
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(json::parse(run.out)["features"].empty());
}

TEST(CoverCommand, RefusesWhatItCannotUnderstandInOneLine) {
  const tests::TemporaryFolder folder;
  const std::string rubbish = file(folder, "rubbish.geojson", std::string("\x7f\x00\xff{", 4));
  const std::string points = file(folder, "points.geojson", R"({"type":"Point","coordinates":[1,2]})");
  struct Row {
    std::vector<std::string> words;
    int status;
  };
  // Every form of bad region: tests/unit/app/region_options_test.cpp.
  for (const Row& row :
       {Row{{"--level", "5"}, 2}, Row{{"--cone", "1,2,3km", "--level", "29"}, 2},
        Row{{"--cone", "1,2,3parsec", "--level", "5"}, 2},
        Row{{"--polygon", "0,0 10,10 0,10 10,0", "--level", "5"}, 2},
        Row{{"--polygon", rubbish, "--level", "5"}, 1}, Row{{"--polygon", points, "--level", "5"}, 2},
        Row{{"--cone", "1,2,3km", "--box", "1,2,3,4", "--level", "5"}, 2},
        Row{{"--cone", "1,2,3km", "--level", "5", "--json", "--geojson"}, 2}}) {
    const Outcome run = cover(row.words);
    std::string shown;
    for (const std::string& word : row.words) shown += word + " ";
    EXPECT_EQ(run.status, row.status) << shown << run.err;
    EXPECT_EQ(run.out, "") << shown;
    EXPECT_EQ(run.err.substr(0, 7), "globe: ") << shown << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << shown << run.err;
  }
}

}  // namespace
