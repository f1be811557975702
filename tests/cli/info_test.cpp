#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/make_planet.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;

class InfoCommand : public testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  std::string planet_ = cli::make_planet(folder_.path(), {"--level", "5"});
};

TEST_F(InfoCommand, CountsNodesAndMeasuresHeights) {
  const Outcome run = run_program({"info", planet_, "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json height = nlohmann::json::parse(run.out)["layers"][0];
  EXPECT_EQ(height["nodes"], 4 * 33 * 33);
  EXPECT_DOUBLE_EQ(height["nodes_to_map_pixels"].get<double>(), 4.0 * 33 * 33 / (8 * 32 * 32));
  EXPECT_LT(height["min"].get<double>(), height["mean"].get<double>());
  EXPECT_LT(height["mean"].get<double>(), height["max"].get<double>());
  const nlohmann::json summary =
      nlohmann::json::parse(run_program({"summary", planet_, "--box=-180,-90,180,90", "--json"}).out);
  EXPECT_NEAR(height["mean"].get<double>(), summary["mean_m"].get<double>(), 0.02);
  const Outcome text = run_program({"info", planet_});
  EXPECT_NE(text.out.find("4356 nodes, 0.5317 of the 128 x 64 pixels"), std::string::npos) << text.out;
}

TEST_F(InfoCommand, VerifyTellsOfDamageOnStandardErrorAndByItsStatus) {
  const Outcome sound = run_program({"info", planet_, "--verify"});
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_NE(sound.out.find("17 files are as they were written"), std::string::npos) << sound.out;
  std::fstream file(planet_ + "/height_2.tif", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(200).put('!');
  file.close();
  const Outcome damaged = run_program({"info", planet_, "--verify"});
  EXPECT_EQ(damaged.status, 1);
  EXPECT_NE(damaged.err.find("height_2.tif: contents changed (checksum differs); convert the map again"),
            std::string::npos)
      << damaged.err;
  EXPECT_EQ(damaged.out.find("verified"), std::string::npos);
  const nlohmann::json info = nlohmann::json::parse(run_program({"info", planet_, "--verify", "--json"}).out);
  EXPECT_FALSE(info["damage"].empty());
  EXPECT_EQ(info["verified"]["files"], 17);
  EXPECT_EQ(run_program({"info", "procedural", "--verify"}).status, 0);
}

TEST_F(InfoCommand, TellsOfAPlanetConvertedAsTheThesisHasIt) {
  const std::string planet = (folder_ / "thesis").string();
  const Outcome made = run_program(
      {"convert", (folder_ / "map.tif").string(), "-o", planet, "--level", "5", "--as-thesis", "--quiet"});
  ASSERT_EQ(made.status, 0);
  EXPECT_NE(made.err.find("warning: --as-thesis puts the ground up to 1083 km from where it is"),
            std::string::npos)
      << made.err;
  const std::string credits =
      nlohmann::json::parse(run_program({"info", planet, "--json"}).out)["credits"].dump();
  EXPECT_NE(credits.find("AS THE THESIS HAS IT"), std::string::npos) << credits;
  const auto height = [](const std::string& of, const char* at) {
    return nlohmann::json::parse(run_program({"height", of, "--json", at}).out)["height_m"].get<double>();
  };
  EXPECT_EQ(height(planet, "0,90"), height(planet_, "0,90")) << "right on the meridians between diamonds";
  EXPECT_NE(height(planet, "54.7356,45"), height(planet_, "54.7356,45"));
}

}  // namespace
