#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/cli/run_program.h"
#include "tests/cli/write_map.h"

namespace {

using cli::Outcome;
using cli::run_program;
using cli::write_map;
using tests::TemporaryFolder;

/// One line for people: "globe: WHAT: WHY; WHAT TO DO".
void expect_refusal(const Outcome& result, int status, const std::string& part) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.rfind("globe: ", 0), 0U) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
}

TEST(ConvertCommand, MakesAPlanetThatInfoDescribes) {
  const TemporaryFolder folder;
  write_map(folder / "map.tif", 128, 64);
  const std::string planet = (folder / "planet").string();
  const Outcome made =
      run_program({"convert", (folder / "map.tif").string(), "-o", planet, "--credit", "by hand"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, "");
  for (const char* part : {"wgs84 assumed", "level 5", "filter bilinear",
                           "longitudes -180 to 180, latitudes -90 to 90 (assumed"})
    EXPECT_NE(made.err.find(part), std::string::npos) << part << " in " << made.err;

  const Outcome told = run_program({"info", planet, "--json", "--verify"});
  ASSERT_EQ(told.status, 0) << told.err;
  const nlohmann::json info = nlohmann::json::parse(told.out);
  EXPECT_EQ(info["layers"][0]["name"], "height");
  EXPECT_EQ(info["layers"][0]["level"], 5);
  EXPECT_EQ(info["credits"][0], "by hand");
  EXPECT_TRUE(info["damage"].empty());
  const Outcome text = run_program({"info", planet});
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.out.find("height_range"), std::string::npos) << text.out;
}

TEST(ConvertCommand, TakesNegativeValuesAndQuiet) {
  const TemporaryFolder folder;
  write_map(folder / "map.tif", 64, 32);
  const Outcome made =
      run_program({"convert", (folder / "map.tif").string(), "-o", (folder / "p").string(), "--offset",
                   "-100", "--extent", "-180,-90,180,90", "--nodata=-9999", "--quiet"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.err, "");
  const nlohmann::json info =
      nlohmann::json::parse(run_program({"info", (folder / "p").string(), "--json"}).out);
  EXPECT_LT(info["layers"][0]["min"], 0.0);
}

TEST(ConvertCommand, PrintsProgressForPrograms) {
  const TemporaryFolder folder;
  write_map(folder / "map.tif", 1024, 512);
  const Outcome made = run_program({"convert", (folder / "map.tif").string(), "-o", (folder / "p").string(),
                                    "--quiet", "--progress", "json"});
  ASSERT_EQ(made.status, 0) << made.err;
  std::istringstream lines(made.err);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_TRUE(nlohmann::json::parse(line).contains("percent"));
  EXPECT_GT(count, 3);
}

TEST(ConvertCommand, RefusesBadInputsWithOneLine) {
  const TemporaryFolder folder;
  const std::string map = (folder / "map.tif").string();
  const std::string planet = (folder / "planet").string();
  write_map(map, 64, 32);
  write_map(folder / "square.tif", 64, 64);
  std::ofstream(folder / "letter.tif") << "Dear Sir or Madam";
  const auto convert = [&](std::vector<std::string> args) {
    args.insert(args.begin(), "convert");
    args.insert(args.end(), {"-o", planet, "--quiet"});
    return run_program(args);
  };
  expect_refusal(convert({(folder / "absent.tif").string()}), 1, "no such file");
  expect_refusal(convert({(folder / "letter.tif").string()}), 1, "not a readable image");
  expect_refusal(convert({(folder / "square.tif").string()}), 1, "not a 2:1 map");
  expect_refusal(convert({map, "--frobnicate"}), 2, "frobnicate");
  expect_refusal(convert({}), 2, "no map given");
  expect_refusal(convert({map, "--filter", "magic"}), 2, "filter");
  expect_refusal(convert({map, "--level", "99"}), 2, "level");
  expect_refusal(convert({map, "--extent", "0,-90,360"}), 2, "W,S,E,N");
  expect_refusal(convert({map, "--extent", "0,-90,180,95"}), 1, "no part of a planet");
  expect_refusal(convert({map, "--extent", "auto", "--extent", "auto", "--extent", "auto"}), 2,
                 "3 times for 1 map");
  expect_refusal(convert({map, "--ellipsoid", "pluto"}), 2, "pluto");
  expect_refusal(convert({map, "--ellipsoid", "-5,0"}), 2, "positive");
  expect_refusal(convert({map, "--nodata", "many"}), 2, "not a number");
  expect_refusal(run_program({"convert", map}), 2, "output");
  std::filesystem::resize_file(map, std::filesystem::file_size(map) / 2);
  expect_refusal(convert({map}), 1, "map.tif");
  EXPECT_FALSE(std::filesystem::exists(planet));
  EXPECT_FALSE(std::filesystem::exists(planet + ".partial"));
  expect_refusal(run_program({"info", planet}), 1, "not a planet");
}

TEST(ConvertCommand, RefusesAnExistingPlanetUnlessToldToReplaceIt) {
  const TemporaryFolder folder;
  write_map(folder / "map.tif", 64, 32);
  const std::vector<std::string> args{"convert", (folder / "map.tif").string(), "-o",
                                      (folder / "planet").string(), "--quiet"};
  EXPECT_EQ(run_program(args).status, 0);
  expect_refusal(run_program(args), 1, "--overwrite");
  std::vector<std::string> again = args;
  again.insert(again.end(), {"--overwrite", "--level", "2"});
  EXPECT_EQ(run_program(again).status, 0);
  EXPECT_NE(run_program({"info", (folder / "planet").string(), "--json"}).out.find("\"level\":2"),
            std::string::npos);
}

TEST(ConvertCommand, KilledAtAnyMomentLeavesNoUnfinishedPlanet) {
  const TemporaryFolder folder;
  const TemporaryFolder streams;
  write_map(folder / "map.tif", 2048, 1024);
  const std::string planet = (folder / "planet").string();
  const std::vector<std::string> args{
      "convert", (folder / "map.tif").string(), "-o", planet, "--quiet", "--level", "9"};
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run_program(args).status, 0);
  const auto whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string reference = cli::text_of(planet + "/planet.json");
  std::filesystem::remove_all(planet);
  std::mt19937 random(20240501);
  const int kills = std::getenv("GLOBE_TEST_FULL") != nullptr ? 200 : 8;
  int unfinished = 0;
  for (int k = 0; k < kills; ++k) {
    const pid_t child = cli::start(args, streams.path());
    std::this_thread::sleep_for(
        std::chrono::duration<double>(whole * std::uniform_real_distribution<>(0.0, 1.1)(random)));
    ::kill(child, k % 3 == 0 ? SIGTERM : SIGKILL);
    cli::wait_for(child);
    if (std::filesystem::exists(planet)) {
      EXPECT_EQ(run_program({"info", planet, "--verify"}).status, 0);
      EXPECT_EQ(cli::text_of(planet + "/planet.json"), reference);
      std::filesystem::remove_all(planet);
    } else {
      ++unfinished;
    }
  }
  EXPECT_GT(unfinished, 0);
  EXPECT_EQ(run_program(args).status, 0) << "what a killed conversion leaves does not stand in the way";
  EXPECT_EQ(cli::text_of(planet + "/planet.json"), reference);
  EXPECT_FALSE(std::filesystem::exists(planet + ".partial"));
}

}  // namespace
