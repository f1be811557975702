#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

json height(const std::string& planet, const std::string& point, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"height", planet, "--json", point});
  const Outcome run = run_program(options);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  return json::parse(run.out);
}

std::vector<std::string> keys(const std::string& line) {
  std::vector<std::string> names;
  const auto object = nlohmann::ordered_json::parse(line);
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

TEST(Height, AnswersTheKeysOfTheContractInOrder) {
  const Outcome run = run_program({"height", "procedural", "--json", "1 2"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(keys(run.out),
            (std::vector<std::string>{"lat", "lon", "level", "height_m", "source", "error_m", "datum"}));
  EXPECT_EQ(json::parse(run.out)["source"], "synthesised");
  EXPECT_TRUE(json::parse(run.out)["error_m"].is_null());
  EXPECT_EQ(json::parse(run.out)["datum"], "ellipsoid");
  EXPECT_NE(run_program({"height", "procedural", "1 2"}).out.find(" 9 "), std::string::npos);
}

TEST(Height, WarnsOnceARunWhenTheDatumIsUnknown) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {});
  const Outcome run = run_program({"height", planet, "1 2", "3 4", "-5,-6"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.lines().size(), 3u);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(run.err.substr(0, 16), "globe: warning: ");
}

TEST(Height, DeeperLevelsAreSynthesisedAndKeepTheNodesOfTheData) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {});
  for (const char* node : {"90 0", "0 90", "45 0", "-45 -180"}) {
    const json data = height(planet, node);
    const json deep = height(planet, node, {"--level", "12"});
    EXPECT_EQ(data["level"], 4);
    EXPECT_EQ(data["source"], "data");
    EXPECT_TRUE(data["error_m"].is_number());
    EXPECT_EQ(deep["source"], "synthesised");
    EXPECT_TRUE(deep["error_m"].is_null());
    EXPECT_NEAR(deep["height_m"].get<double>(), data["height_m"].get<double>(), 1e-9) << node;
  }
  EXPECT_NE(height(planet, "12.3 45.6")["height_m"],
            height(planet, "12.3 45.6", {"--level", "12"})["height_m"]);
}

TEST(Height, EveryInterpolationStaysInTheRangeOfTheSamples) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {});
  const json layer = json::parse(run_program({"info", planet, "--json"}).out)["layers"][0];
  std::mt19937 random(13);
  std::string points = "90 0\n-90 0\n0 0\n0 90\n0 -180\n0 -90\n";
  for (int k = 0; k < 3000; ++k) {
    points += std::to_string(std::uniform_real_distribution<>(-90, 90)(random)) + ' ' +
              std::to_string(std::uniform_real_distribution<>(-180, 180)(random)) + '\n';
  }
  for (const char* interpolation : {"nearest", "linear", "cubic"}) {
    const Outcome run = run_program({"height", planet, "--json", "--interpolation", interpolation}, points);
    EXPECT_EQ(run.status, 0);
    for (const std::string& line : run.lines()) {
      const double found = json::parse(line)["height_m"].get<double>();
      ASSERT_GE(found, layer["min"].get<double>() - 1e-9) << interpolation << ' ' << line;
      ASSERT_LE(found, layer["max"].get<double>() + 1e-9) << interpolation << ' ' << line;
    }
  }
}

TEST(Height, InterpolationsAgreeAtNodesAndDifferBetweenThem) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {});
  const auto with = [&](const char* point, const char* interpolation) {
    return height(planet, point, {"--interpolation", interpolation})["height_m"].get<double>();
  };
  for (const char* node : {"90 0", "0 0", "45 90"}) {
    EXPECT_NEAR(with(node, "linear"), with(node, "nearest"), 1e-9) << node;
    EXPECT_NEAR(with(node, "linear"), with(node, "cubic"), 1e-9) << node;
  }
  EXPECT_NE(with("12.3 45.6", "linear"), with("12.3 45.6", "nearest"));
  EXPECT_NE(with("12.3 45.6", "linear"), with("12.3 45.6", "cubic"));
}

TEST(Height, DrawnIsTheFlatTrixelBelowTheCurve) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {"--ellipsoid", "moon"});
  for (const char* node : {"90 0", "0 0", "45 90", "-45 -180"}) {
    EXPECT_NEAR(height(planet, node, {"--drawn"})["height_m"].get<double>(),
                height(planet, node)["height_m"].get<double>(), 1e-6)
        << node;
  }
  // Level 4 on the Moon: edges of 120 to 220 km, L²/6R = 1.4 to 4.6 km in the middle of a trixel.
  const std::string middle = "32.3 74.1";
  const json flat = height(planet, middle, {"--drawn"});
  const json curved = height(planet, middle);
  const double below = curved["height_m"].get<double>() - flat["height_m"].get<double>();
  EXPECT_GT(below, 100.0);
  EXPECT_LT(below, 5000.0);
  EXPECT_NEAR(flat["error_m"].get<double>(), curved["error_m"].get<double>() + below, 1e-6);
  EXPECT_EQ(flat["source"], "data");
  EXPECT_NEAR(height(planet, middle, {"--drawn", "--level", "16"})["height_m"].get<double>(),
              height(planet, middle, {"--level", "16"})["height_m"].get<double>(), 0.01);
}

TEST(Height, DrawnSeaIsAtHeightZero) {
  const json drawn = height("procedural", "0 -90", {"--drawn", "--level", "20"});
  EXPECT_LT(height("procedural", "0 -90", {"--level", "20"})["height_m"].get<double>(), -100.0);
  EXPECT_NEAR(drawn["height_m"].get<double>(), 0.0, 0.01);
}

TEST(Height, AnswersBadPointsOnTheirOwnLineAndGoesOn) {
  const Outcome run = run_program({"height", "procedural"}, "# points\n1 2\nnorth\n-3,4\n");
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "# points");
  EXPECT_EQ(lines[2].substr(0, 7), "ERROR: ");
  EXPECT_EQ(lines[3].substr(0, 5), "-3 4 ");
}

TEST(Height, RefusesUnknownWords) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"height"},
        {"height", "procedural", "--interpolation", "magic", "1 2"},
        {"height", "procedural", "--level", "29", "1 2"},
        {"height", "procedural", "--drawn", "--interpolation", "cubic", "1 2"},
        {"height", "procedural:seven", "1 2"}}) {
    const Outcome run = run_program(words);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

TEST(Planet, BrokenFoldersAreRefusedWithOneLine) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {});
  const std::string empty = (folder / "empty").string();
  std::filesystem::create_directory(empty);
  std::filesystem::resize_file(planet + "/height_2.tif", 100);
  for (const std::string& broken : {empty, planet}) {
    for (const char* command : {"height", "lookup", "info"}) {
      const Outcome run = run_program({command, broken});
      EXPECT_EQ(run.status, 1) << command;
      EXPECT_EQ(run.out, "") << command;
      EXPECT_EQ(run.err.substr(0, 7), "globe: ");
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
  }
}

TEST(Planet, WithoutHeightsIsRefusedByName) {
  const tests::TemporaryFolder folder;
  cli::make_planet(folder.path(), {});
  const std::string planet = (folder / "colors").string();
  const Outcome made =
      run_program({"convert", "--color", (folder / "map.tif").string(), "-o", planet, "--quiet"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Outcome run = run_program({"height", planet, "1 2"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("no heights"), std::string::npos) << run.err;
}

TEST(Planet, InfoDescribesTheBuiltInOne) {
  const Outcome run = run_program({"info", "procedural:7", "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const json info = json::parse(run.out);
  EXPECT_EQ(info["name"], "procedural:7");
  EXPECT_EQ(info["datum"], "ellipsoid");
  EXPECT_EQ(info["layers"][0]["level"], 9);
  EXPECT_EQ(run_program({"info", "procedural:x"}).status, 2);
}

// The map's pixels are means over 20 arc-minutes (37 km): a summit of 8849 m is some 5400 m there.
TEST(HeightOfTheEarth, IsThatOfTheMapAtKnownPlaces) {
  const std::filesystem::path map = GLOBE_DATA_DIR "/earth/earth_etopo20_f32.tif";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << map;
  const tests::TemporaryFolder folder;
  const std::string planet = (folder / "earth").string();
  ASSERT_EQ(run_program({"convert", map.string(), "-o", planet, "--quiet"}).status, 0);
  struct Spot {
    const char* name;
    const char* point;
    double low_m, high_m;
  };
  for (const Spot& spot :
       {Spot{"Cape Comorin, coast of India", "8.08 77.55", -100, 200},
        Spot{"sea off Mumbai", "18.5 70.5", -1000, -5},
        Spot{"Deccan inland of Mumbai", "18.5 74.5", 300, 900},
        Spot{"Everest's cell", "27.99 86.92", 4800, 6000}, Spot{"Tibet", "32 88", 4500, 5500},
        Spot{"Challenger Deep", "11.35 142.2", -8500, -6500}, Spot{"Dead Sea", "31.5 35.5", -450, 400},
        Spot{"Denver", "39.7 -105", 1400, 2300}, Spot{"mid Pacific", "0 -150", -6000, -3500},
        Spot{"south pole", "-90 0", 2600, 3000}, Spot{"north pole", "90 0", -4400, -4000},
        Spot{"antimeridian", "0 180", -6500, -3500}}) {
    const json found = height(planet, spot.point);
    EXPECT_GE(found["height_m"].get<double>(), spot.low_m) << spot.name;
    EXPECT_LE(found["height_m"].get<double>(), spot.high_m) << spot.name;
    EXPECT_EQ(found["source"], "data");
  }
}

}  // namespace
