#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

json look(const std::string& planet, const std::string& a, const std::string& b,
          std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"sight", planet, a, b, "--json"});
  const Outcome run = run_program(options);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  return json::parse(run.out);
}

double ground_m(const std::string& planet, const std::string& point) {
  const Outcome run = run_program({"height", planet, "--json", point});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  return json::parse(run.out)["height_m"].get<double>();
}

TEST(Sight, AnswersTheKeysOfTheContract) {
  const Outcome run = run_program({"sight", "procedural", "0,0,20km", "0,1,20km", "--json"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  std::vector<std::string> names;
  const auto object = nlohmann::ordered_json::parse(run.out);
  for (const auto& item : object.items()) names.push_back(item.key());
  EXPECT_EQ(names,
            (std::vector<std::string>{"visible", "blocked_at", "clearance_m", "clearance_at", "distance_m",
                                      "range_m", "eye1_m", "eye2_m", "refraction", "level", "datum"}));
  EXPECT_TRUE(object["visible"].get<bool>());
  EXPECT_TRUE(object["blocked_at"].is_null());
  EXPECT_NEAR(object["distance_m"].get<double>(), 111319.49, 0.01);
  EXPECT_EQ(object["eye1_m"], 20000.0);
  EXPECT_EQ(object["level"], 9);
}

TEST(Sight, AnEyeWithoutAltStandsTwoMetresAboveGroundAndAglCountsFromThere) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {"--ellipsoid", "moon"});
  const double ground = ground_m(planet, "12.3 45.6");
  EXPECT_NEAR(look(planet, "12.3 45.6", "12.3 45.7")["eye1_m"].get<double>(), ground + 2.0, 1e-6);
  const json agl = look(planet, "12.3 45.6 30", "12.3 45.7", {"--agl"});
  EXPECT_NEAR(agl["eye1_m"].get<double>(), ground + 30.0, 1e-6);
  EXPECT_NEAR(agl["eye2_m"].get<double>(), ground_m(planet, "12.3 45.7") + 2.0, 1e-6);
  EXPECT_EQ(look(planet, "12.3 45.6 5000", "12.3 45.7")["eye1_m"], 5000.0);
  EXPECT_NEAR(look(planet, "12.3 45.6 5000", "12.3 45.6 9000")["clearance_m"].get<double>(), 5000.0 - ground,
              1e-6);
}

TEST(Sight, TheSeaIsGroundAtHeightNothing) {
  // The built-in planet's sea: eyes 10 m above it have their horizons 11.3 km away, whatever its floor.
  const std::string sea = "0 0", far = "0 0.3";
  ASSERT_LT(ground_m("procedural", sea), -50.0);
  ASSERT_LT(ground_m("procedural", far), -50.0);
  EXPECT_EQ(look("procedural", sea, far, {})["eye1_m"], 2.0);
  EXPECT_FALSE(look("procedural", "0 0 10", "0 0.3 10")["visible"].get<bool>());
  EXPECT_TRUE(look("procedural", "0 0 100", "0 0.3 100")["visible"].get<bool>());
}

TEST(Sight, RefractionLooksFarther) {
  // 40 km over the sea: from 31 m straight, from 27 m with the air's 0.13.
  EXPECT_FALSE(look("procedural", "0 0 29", "0 0.35932 29")["visible"].get<bool>());
  EXPECT_TRUE(look("procedural", "0 0 29", "0 0.35932 29", {"--refraction", "0.13"})["visible"].get<bool>());
  EXPECT_FALSE(look("procedural", "0 0 26", "0 0.35932 26", {"--refraction=.13"})["visible"].get<bool>());
  EXPECT_TRUE(look("procedural", "0 0 32", "0 0.35932 32")["visible"].get<bool>());
}

TEST(Sight, WhereItIsBlockedStandsGround) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {"--ellipsoid", "moon"});
  const json found = look(planet, "10 20 1200", "10 28 1200");
  ASSERT_FALSE(found["visible"].get<bool>());
  const json& at = found["blocked_at"];
  char place[100];
  std::snprintf(place, sizeof place, "%.17g %.17g", at["lat"].get<double>(), at["lon"].get<double>());
  EXPECT_NEAR(ground_m(planet, place), at["height_m"].get<double>(), 1e-3);
  const Outcome distance = run_program({"distance", "10 20", place, "--ellipsoid", "moon"});
  EXPECT_NEAR(std::stod(distance.out), at["distance_m"].get<double>(), 1e-6);
  EXPECT_LT(found["clearance_m"].get<double>(), 0.0);
}

TEST(Sight, ReadsAPairALineAndAnswersBadOnesOnTheirOwn) {
  const Outcome run = run_program({"sight", "procedural", "--precision", "1"},
                                  "# looks\n0 0 20000 0 1 20000\n0,0,20km ; 0,1,20km\n0 0 0\nnan 0 0 0\n"
                                  "0 0 91 0\n0 0 1e12 0 1 0\n0 0 0 0.0001\n");
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[0], "# looks");
  EXPECT_EQ(lines[1].substr(0, 8), "visible ");
  EXPECT_EQ(lines[1], lines[2]);
  for (const std::size_t bad : {3u, 4u, 5u, 6u}) EXPECT_EQ(lines[bad].substr(0, 7), "ERROR: ");
  EXPECT_EQ(lines[7].substr(0, 12), "visible 2.0 ");
  const auto table = run_program({"sight", "procedural", "--csv"}, "0 0 0 0\n").lines();
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0], "state,clearance_m,lat,lon,at_m,distance_m");
  EXPECT_EQ(table[1], "visible,2,0,0,0,0");
}

TEST(Sight, ManyAnswersAreThoseOfOneByOne) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {"--ellipsoid", "moon"});
  std::string lines;
  for (int k = 0; k < 300; ++k)
    lines += std::to_string(k % 60) + " " + std::to_string(k) + " 900 " + std::to_string(k % 60 + 1) + " " +
             std::to_string(k + 2) + " 1100\n";
  const auto answers = run_program({"sight", planet}, lines).lines();
  ASSERT_EQ(answers.size(), 300u);
  std::istringstream questions(lines);
  std::size_t k = 0;
  for (std::string line; std::getline(questions, line); ++k) {
    if (k % 30 != 0) continue;
    EXPECT_EQ(run_program({"sight", planet}, line + "\n").lines().at(0), answers[k]) << line;
  }
}

TEST(Sight, RefusesWhatItCannotMeanWithOneLine) {
  const tests::TemporaryFolder folder;
  cli::make_planet(folder.path(), {});
  const std::string colors = cli::make_color_planet(folder.path());
  cli::expect_refusals("sight", {cli::Refusal{{}, 2}, cli::Refusal{{"procedural", "0,0"}, 2},
                                 cli::Refusal{{"procedural", "0,0", "1,1", "2,2"}, 2},
                                 cli::Refusal{{"procedural", "0,0", "1,1", "--refraction", "1.5"}, 2},
                                 cli::Refusal{{"procedural", "0,0", "1,1", "--refraction", "nan"}, 2},
                                 cli::Refusal{{"procedural", "0,0", "1,1", "--level", "29"}, 2},
                                 cli::Refusal{{(folder / "nowhere").string(), "0,0", "1,1"}, 1},
                                 cli::Refusal{{colors, "0,0", "1,1"}, 1}});
}

// The map's pixels are means over 37 km: mountains are lower and broader there, so that eyes stand at the
// true summits.
TEST(SightOfTheEarth, EverestSeesKanchenjungaAndNotLhasa) {
  const std::filesystem::path map = GLOBE_DATA_DIR "/earth/earth_etopo20_f32.tif";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << map;
  const tests::TemporaryFolder folder;
  const std::string planet = (folder / "earth").string();
  ASSERT_EQ(run_program({"convert", map.string(), "-o", planet, "--level", "10", "--quiet"}).status, 0);
  const std::string everest = "27.9881 86.9250 8848";
  const json kanchenjunga = look(planet, everest, "27.7025 88.1475 8586", {"--refraction", "0.13"});
  EXPECT_TRUE(kanchenjunga["visible"].get<bool>());
  EXPECT_GT(kanchenjunga["clearance_m"].get<double>(), 1000.0);
  EXPECT_NEAR(kanchenjunga["distance_m"].get<double>(), 124.5e3, 100.0);
  EXPECT_TRUE(look(planet, everest, "27.8069 86.7140")["visible"].get<bool>()) << "Namche Bazaar";
  const json lhasa = look(planet, everest, "29.65 91.17", {"--refraction", "0.13"});
  EXPECT_FALSE(lhasa["visible"].get<bool>());
  EXPECT_GT(lhasa["blocked_at"]["height_m"].get<double>(), 4000.0);
  EXPECT_LT(lhasa["blocked_at"]["distance_m"].get<double>(), 300e3);
  EXPECT_TRUE(look(planet, everest, "0 86.9 36000km")["visible"].get<bool>()) << "a geostationary satellite";
}

}  // namespace
