#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

/// A folder with databases in it.
class FindCommand : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }
  std::string database() const { return (folder_ / "a.db").string(); }

  Outcome index(const std::string& name, const std::string& text, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"index", file(name, text), "-o", database(), "--overwrite", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }

  Outcome find(std::vector<std::string> words) const {
    words.insert(words.begin(), {"find", database()});
    return run_program(words);
  }

  /// Ids of what is found, in its order.
  std::vector<int> ids(std::vector<std::string> words) const {
    words.push_back("--json");
    const Outcome run = find(std::move(words));
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    std::vector<int> found;
    for (const std::string& line : run.lines()) found.push_back(json::parse(line)["id"].get<int>());
    return found;
  }

  tests::TemporaryFolder folder_;
};

using Ids = std::vector<int>;

constexpr const char* kCities =
    "name,lat,lon,country,people\n"
    "Wien,48.2082,16.3738,AT,1900000\n"
    "Bratislava,48.1486,17.1077,SK,440000\n"
    "Graz,47.0707,15.4395,AT,290000\n"
    "\"Paris, Texas\",33.6609,-95.5555,US,25000\n"
    "Suva,-18.1416,178.4419,FJ,94000\n"
    "Apia,-13.8333,-171.7667,WS,37000\n"
    "Pole,90,0,,\n";

TEST_F(FindCommand, AnswersAllKeysOfTheContract) {
  ASSERT_EQ(index("a.csv", kCities).status, 0);
  const Outcome run = find({"--near", "48.2,16.37", "--radius", "60km", "--json"});
  ASSERT_EQ(run.lines().size(), 2u) << run.err;
  const json wien = json::parse(run.lines()[0]);
  EXPECT_EQ(wien["name"], "Wien");
  EXPECT_EQ(wien["lat"], 48.2082);
  EXPECT_EQ(wien["lon"], 16.3738);
  EXPECT_EQ(wien["id"], 1);
  EXPECT_EQ(wien["properties"], (json{{"country", "AT"}, {"people", "1900000"}}));
  // 0.0082 degrees of latitude and 0.0038 of longitude: 911.8 m and 282.5 m.
  EXPECT_NEAR(wien["distance_m"].get<double>(), 954.5, 0.5);
  EXPECT_EQ(json::parse(run.lines()[1])["name"], "Bratislava");
  const json pole = json::parse(find({"--name", "pole", "--json"}).out);
  EXPECT_TRUE(pole["distance_m"].is_null());
  EXPECT_EQ(pole["properties"], json::object());
}

TEST_F(FindCommand, WritesTextAndTables) {
  index("a.csv", kCities);
  EXPECT_EQ(find({"--name", "paris", "--precision", "2"}).out, "33.66 -95.56 - 4 Paris, Texas\n");
  const Outcome table = find({"--name", "paris", "--csv"});
  EXPECT_EQ(
      table.out,
      "name,lat,lon,distance_m,id,properties\n"
      "\"Paris, Texas\",33.6609,-95.5555,,4,\"{\"\"country\"\":\"\"US\"\",\"\"people\"\":\"\"25000\"\"}\"\n");
}

TEST_F(FindCommand, AnEmptyAnswerIsASuccess) {
  index("a.csv", kCities);
  const Outcome run = find({"--near", "0,0", "--radius", "1m"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out + run.err, "");
}

TEST_F(FindCommand, OrdersByDistanceElseById) {
  index("a.csv", kCities);
  EXPECT_EQ(ids({}), (Ids{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(ids({"--count", "2"}), (Ids{1, 2}));
  EXPECT_EQ(ids({"--near", "48.15,17.1", "--count", "3"}), (Ids{2, 1, 3}));
  EXPECT_EQ(ids({"--near", "90,123"}).front(), 7);
  EXPECT_EQ(ids({"--near", "90,123"}).size(), 7u);
}

TEST_F(FindCommand, TakesEveryRegionAndCombinesTheFilters) {
  index("a.csv", kCities);
  EXPECT_EQ(ids({"--box", "15,46,17,49"}), (Ids{1, 3}));
  EXPECT_EQ(ids({"--box", "170,-20,-170,-10"}), (Ids{5, 6}));
  EXPECT_EQ(ids({"--cone", "48.2,16.37,60km"}), (Ids{1, 2}));
  EXPECT_EQ(ids({"--cone", "48.2,16.37,60km", "--complement"}), (Ids{3, 4, 5, 6, 7}));
  EXPECT_EQ(ids({"--polygon", "46,15 46,17 49,17 49,15"}), (Ids{1, 3}));
  EXPECT_EQ(ids({"--polygon", "46,15 46,17 49,17 49,15", "--edges", "map", "--name", "GR"}), (Ids{3}));
  EXPECT_EQ(ids({"--where", "country=AT"}), (Ids{1, 3}));
  EXPECT_EQ(ids({"--where", "country=AT", "--where", "people=290000"}), (Ids{3}));
  EXPECT_EQ(ids({"--where", "country=AT", "--near", "47,15.4", "--count", "1"}), (Ids{3}));
  EXPECT_EQ(ids({"--near", "-15,-179", "--radius", "10deg"}), (Ids{5, 6}));
}

TEST_F(FindCommand, QuotesAndSqlAreTextLikeAnyOther) {
  index("a.csv",
        "lat,lon,name,\"a\"\"b'c\"\n"
        "1,1,\"'; DROP TABLE point; --\",\"x\"\" OR 1=1\"\n"
        "2,2,%,_\n");
  EXPECT_EQ(ids({"--name", "'; drop"}), (Ids{1}));
  EXPECT_EQ(ids({"--name", "%"}), (Ids{2}));
  EXPECT_EQ(ids({"--name", "_"}), (Ids{}));
  EXPECT_EQ(ids({"--where", "a\"b'c=x\" OR 1=1"}), (Ids{1}));
  EXPECT_EQ(ids({"--where", "a\"b'c=' OR '1'='1"}), (Ids{}));
  EXPECT_EQ(ids({}), (Ids{1, 2}));
}

TEST_F(FindCommand, BadLinesAreNamedAndLeftOut) {
  const Outcome run = index("a.csv", "lat,lon,name\n1,2,a\nx,2,b\n91,2,c\n3,4,\"d\n5,6,e\n");
  EXPECT_EQ(run.status, 1);
  const std::string path = (folder_ / "a.csv").string();
  EXPECT_EQ(run.err, "globe: " + path + ":3: the latitude 'x' is no number of degrees\n" + "globe: " + path +
                         ":4: the latitude '91' is beyond 90 degrees\n" + "globe: " + path +
                         ":5: a quoted field has no end\n");
  EXPECT_EQ(ids({}), (Ids{1, 2}));
}

TEST_F(FindCommand, StrictStopsAtTheFirstBadLineAndLeavesNothing) {
  const Outcome run = index("a.csv", "lat,lon\n1,2\nx,2\ny,3\n", {"--strict"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_FALSE(std::filesystem::exists(database()));
}

TEST_F(FindCommand, ReadsGeoJsonAndNumbersFeaturesThroughAllFiles) {
  const std::string more = file("b.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","id":"q1","properties":{"NAME":"Praha","n":1.5},"geometry":{"type":"Point","coordinates":[14.42,50.09]}},
    {"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":[14,95]}},
    {"type":"Feature","properties":{"deep":{"a":[1,2]}},"geometry":{"type":"Point","coordinates":[15,51]}}]})");
  const Outcome run = index("a.csv", kCities, {more});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find(more + ", feature 2: latitude 95"), std::string::npos) << run.err;
  const json praha = json::parse(find({"--name", "pra", "--json"}).out);
  EXPECT_EQ(praha["id"], 8);
  EXPECT_EQ(praha["properties"], (json{{"id", "q1"}, {"n", 1.5}}));
  EXPECT_EQ(ids({"--where", "n=1.5"}), (Ids{8}));
  EXPECT_EQ(
      json::parse(find({"--near", "51,15", "--count", "1", "--json"}).out)["properties"]["deep"]["a"][1], 2);
}

TEST_F(FindCommand, FindsLinesAndPolygonsThatARegionTouches) {
  const auto feature = [](const std::string& name, const std::string& type, const std::string& coordinates) {
    return R"({"type":"Feature","properties":{"name":")" + name + R"("},"geometry":{"type":")" + type +
           R"(","coordinates":)" + coordinates + "}}";
  };
  const Outcome run =
      index("a.geojson", R"({"type":"FeatureCollection","features":[)" +
                             feature("land", "Polygon", "[[[0,0],[10,0],[10,10],[0,10],[0,0]]]") + "," +
                             feature("road", "LineString", "[[178,0],[-178,0]]") + "," +
                             feature("bow", "Polygon", "[[[0,0],[10,10],[10,0],[0,10],[0,0]]]") + "," +
                             feature("isles", "MultiPoint", "[[50,50],[60,60]]") + "]}");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("feature 3: polygon: the edge from corner 1 crosses"), std::string::npos) << run.err;
  EXPECT_EQ(ids({"--near", "5,5", "--radius", "1m"}), (Ids{1}));
  EXPECT_EQ(ids({"--box", "179,-1,181,1"}), (Ids{2}));
  EXPECT_EQ(ids({"--cone", "60,60,1m"}), (Ids{3}));
  EXPECT_EQ(ids({"--name", "LAND", "--box", "4,4,6,6"}), (Ids{1}));
  const json road = json::parse(find({"--near", "1,180", "--count", "1", "--json"}).out);
  EXPECT_EQ(road["name"], "road");
  EXPECT_NEAR(road["lat"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(std::abs(road["lon"].get<double>()), 180.0, 1e-9);
  // A degree of the meridian from the equator.
  EXPECT_NEAR(road["distance_m"].get<double>(), 110574.389, 0.001);
}

TEST_F(FindCommand, MeasuresOnTheEllipsoidOfTheDatabase) {
  index("a.csv", "lat,lon\n0,1\n", {"--ellipsoid", "moon"});
  const json moon = json::parse(find({"--near", "0,0", "--json"}).out);
  EXPECT_NEAR(moon["distance_m"].get<double>(), 1737400.0 * M_PI / 180.0, 1e-6);
}

TEST_F(FindCommand, RefusesWhatItCannotUnderstandInOneLine) {
  index("a.csv", kCities);
  const std::string text = file("text.db", std::string(4096, 'x'));
  struct Row {
    std::vector<std::string> words;
    int status;
  };
  for (const Row& row :
       {Row{{"find", database(), "--radius", "5km"}, 2},
        Row{{"find", database(), "--near", "91,0"}, 2},
        Row{{"find", database(), "--near", "1,0", "--radius", "-5"}, 2},
        Row{{"find", database(), "--near", "1,0", "--radius", "5parsec"}, 2},
        Row{{"find", database(), "--where", "country"}, 2},
        Row{{"find", database(), "--count", "0"}, 2},
        Row{{"find", database(), "--complement"}, 2},
        Row{{"find", database(), "--json", "--csv"}, 2},
        Row{{"find", database(), "--box", "1,2,3,4", "--cone", "1,2,3"}, 2},
        Row{{"find", database() + "x"}, 1},
        Row{{"find", text}, 1},
        Row{{"find"}, 2},
        Row{{"index", file("a.txt", ""), "-o", database() + "2"}, 2},
        Row{{"index", file("b.csv", ""), "-o", database() + "2"}, 1},
        Row{{"index", file("c.csv", "a,b\n1,2\n"), "-o", database() + "2"}, 1},
        Row{{"index", file("d.geojson", "{"), "-o", database() + "2"}, 1},
        Row{{"index", "none.csv", "-o", database() + "2"}, 1},
        Row{{"index", (folder_ / "a.csv").string(), "-o", database()}, 1},
        Row{{"index", (folder_ / "a.csv").string(), "-o", database(), "--columns", "a"}, 1},
        Row{{"index", (folder_ / "a.csv").string(), "-o", database() + "2", "--columns", "a"}, 2}}) {
    const Outcome run = run_program(row.words);
    std::string shown;
    for (const std::string& word : row.words) shown += word + " ";
    EXPECT_EQ(run.status, row.status) << shown << run.err;
    EXPECT_EQ(run.out, "") << shown;
    EXPECT_EQ(run.err.substr(0, 7), "globe: ") << shown << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << shown << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(database() + "2"));
}

TEST_F(FindCommand, KilledAtAnyMomentLeavesTheOldDatabaseOrNone) {
  std::string text = "lat,lon,name\n";
  for (int k = 0; k < 60000; ++k)
    text += std::to_string(k % 170 - 85) + "." + std::to_string(k) + "," + std::to_string(k % 360) +
            ",place " + std::to_string(k) + "\n";
  const std::string csv = file("big.csv", text);
  const std::string output = (folder_ / "new.db").string();
  std::mt19937 random(7);
  int killed = 0;
  for (int k = 0; k < 12; ++k) {
    const pid_t child = cli::start({"index", csv, "-o", output, "--quiet"}, folder_.path());
    ::usleep(static_cast<useconds_t>(random() % 400000));
    ::kill(child, SIGKILL);
    const bool in_time = cli::wait_for(child) == 128 + SIGKILL && !std::filesystem::exists(output);
    killed += in_time ? 1 : 0;
    if (in_time) continue;
    // The blow came after the last step: everything is there.
    EXPECT_EQ(run_program({"find", output, "--name", "PLACE 59999", "--precision", "0"}).lines().size(), 1u);
    std::filesystem::remove(output);
  }
  EXPECT_GT(killed, 0);
  // What was there stays until the new one is whole.
  ASSERT_EQ(run_program({"index", file("one.csv", "lat,lon\n1,2\n"), "-o", output, "--quiet"}).status, 0);
  const pid_t child = cli::start({"index", csv, "-o", output, "--overwrite", "--quiet"}, folder_.path());
  ::usleep(20000);
  ::kill(child, SIGKILL);
  EXPECT_EQ(cli::wait_for(child), 128 + SIGKILL);
  EXPECT_EQ(run_program({"find", output}).out, "1 2 - 1 -\n");
  ASSERT_EQ(run_program({"index", csv, "-o", output, "--overwrite", "--quiet"}).status, 0);
  EXPECT_EQ(run_program({"find", output, "--name", "PLACE 59999", "--precision", "0"}).lines().size(), 1u);
}

}  // namespace
