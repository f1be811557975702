#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using cli::with;
using nlohmann::json;

/// A camera over the built-in planet's land that sees ground and sky.
const std::vector<std::string> kPickCamera{"--at",   "46,7,4000", "--look",   "120,-10",
                                           "--size", "320x180",   "--detail", "16"};

json pick(const std::string& planet, const std::vector<std::string>& options) {
  const Outcome run = run_program(with({"pick", planet, "--json"}, options));
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  return json::parse(run.out);
}

TEST(Pick, AnswersTheKeysOfTheContract) {
  const Outcome run =
      run_program(with(with({"pick", "procedural", "--json"}, kPickCamera), {"--pixel", "160,90"}));
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  const auto object = nlohmann::ordered_json::parse(run.out);
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  EXPECT_EQ(names, (std::vector<std::string>{"lat", "lon", "height_m", "distance_m", "level", "alpha", "sky",
                                             "datum"}));
  EXPECT_FALSE(object["sky"].get<bool>());
  EXPECT_EQ(object["datum"], "ellipsoid");
  EXPECT_NEAR(object["distance_m"].get<double>(), 22e3, 1e3);
}

TEST(Pick, SkyIsAnAnswer) {
  const json sky = pick("procedural", with(kPickCamera, {"--pixel", "0,0"}));
  EXPECT_TRUE(sky["sky"].get<bool>());
  for (const char* key : {"lat", "lon", "height_m", "distance_m", "level", "alpha"})
    EXPECT_TRUE(sky[key].is_null()) << key;
}

TEST(Pick, TheMiddleOfAViewStraightDownIsUnderTheCamera) {
  const json at = pick("procedural", {"--at", "-90,33,20000km", "--size", "33x33", "--pixel", "16,16"});
  EXPECT_NEAR(at["lat"].get<double>(), -90.0, 1e-9);
  EXPECT_NEAR(at["distance_m"].get<double>() + at["height_m"].get<double>(), 2e7, 1e-3);
  // 1 pixel to the right of a picture whose top is north lies east.
  const json beside = pick("procedural", {"--at", "10,20,5000", "--size", "33x33", "--pixel", "17,16"});
  EXPECT_GT(beside["lon"].get<double>(), 20.0);
  EXPECT_NEAR(beside["lat"].get<double>(), 10.0, 1e-4);
}

TEST(Pick, ThePixelsOfAPictureAreThoseOfItsDepth) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {"--ellipsoid", "moon"});
  const std::string depth = (folder / "depth.exr").string();
  const std::vector<std::string> camera{"--at",   "12,34,900", "--agl",    "--look", "70,-20",
                                        "--size", "64x48",     "--detail", "16"};
  const Outcome drawn = run_program(with(with({"shot", planet, "-o", depth, "--show", "depth"}, camera), {}));
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  std::vector<float> metres(64 * 48);
  const auto image = OIIO::ImageInput::open(depth);
  ASSERT_TRUE(image && image->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, metres.data()));
  std::string pixels;
  for (int k = 0; k < 64 * 48; k += 37)
    pixels += std::to_string(k % 64) + " " + std::to_string(k / 64) + "\n";
  const auto answers = run_program(with({"pick", planet, "--json"}, camera), pixels).lines();
  std::size_t line = 0;
  for (int k = 0; k < 64 * 48; k += 37, ++line) {
    const json answer = json::parse(answers.at(line));
    const auto along = static_cast<double>(metres[static_cast<std::size_t>(k)]);
    ASSERT_EQ(answer["sky"].get<bool>(), along == 0.0) << k;
    if (along == 0.0) continue;
    const double x = ((k % 64 + 0.5) / 32 - 1.0) * 64 / 48 * std::tan(M_PI / 6);
    const double y = ((k / 64 + 0.5) / 24 - 1.0) * std::tan(M_PI / 6);
    EXPECT_NEAR(answer["distance_m"].get<double>() / std::sqrt(1.0 + x * x + y * y), along, 0.01 * along)
        << k;
  }
}

TEST(Pick, ReadsAPixelALineAndAnswersBadOnesOnTheirOwn) {
  const Outcome run = run_program(with({"pick", "procedural", "--precision", "3"}, kPickCamera),
                                  "# pixels\n160,90\n160 90\n 160 , 90\n0,0\n320,0\n-1,0\n1.5,2\nx,y\n7\n");
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_EQ(lines[0], "# pixels");
  EXPECT_EQ(lines[1], lines[2]);
  EXPECT_EQ(lines[1], lines[3]);
  EXPECT_EQ(lines[4], "sky");
  for (std::size_t bad = 5; bad < 10; ++bad)
    EXPECT_EQ(lines[bad].substr(0, 13), "ERROR: line " + std::to_string(bad + 1).substr(0, 1)) << lines[bad];
  const auto table = run_program(with(with({"pick", "procedural", "--csv"}, kPickCamera),
                                      {"--pixel", "160,90", "--pixel", "0,0"}))
                         .lines();
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0], "lat,lon,height_m,distance_m,level,alpha,sky,datum");
  EXPECT_EQ(table[1].substr(table[1].size() - 16), ",false,ellipsoid");
  EXPECT_EQ(table[2], ",,,,,,true,ellipsoid");
}

TEST(Pick, HeightDrawnAgreesWhereNothingIsMorphed) {
  const json at = pick("procedural", with(kPickCamera, {"--pixel", "100,177"}));
  ASSERT_EQ(at["alpha"], 0.0);
  char place[100];
  std::snprintf(place, sizeof place, "%.17g %.17g", at["lat"].get<double>(), at["lon"].get<double>());
  const Outcome height = run_program({"height", "procedural", place, "--drawn", "--level",
                                      std::to_string(at["level"].get<int>()), "--json"});
  EXPECT_NEAR(json::parse(height.out)["height_m"].get<double>(), at["height_m"].get<double>(), 1e-6);
}

TEST(Pick, ExaggeratedGroundStandsSoManyTimesAsHigh) {
  // Straight down, from so high above the ground that the finest level is the same and nothing is morphed.
  const auto height = [](const std::string& times) {
    return pick("procedural", {"--at", "46,7,9000", "--size", "33x33", "--detail", "16", "--pixel", "16,16",
                               "--exaggeration", times})["height_m"]
        .get<double>();
  };
  const double plain = height("1");
  EXPECT_GT(plain, 100.0);
  EXPECT_NEAR(height("0"), 0.0, 1.0);  // the flat trixel sags below the ellipsoid
  EXPECT_NEAR(height("1.5"), 1.5 * plain, 0.02 * plain);
}

TEST(Pick, WithoutMorphingALevelsGroundIsItsOwn) {
  const json on = pick("procedural", with(kPickCamera, {"--pixel", "160,100"}));
  const json off = pick("procedural", with(kPickCamera, {"--pixel", "160,100", "--morph", "off"}));
  EXPECT_EQ(off["alpha"], 0.0);
  EXPECT_NEAR(on["distance_m"].get<double>(), off["distance_m"].get<double>(),
              0.05 * on["distance_m"].get<double>());
}

TEST(Pick, APlanetOfColorsAloneIsPickedAsItIsDrawn) {
  const tests::TemporaryFolder folder;
  cli::make_planet(folder.path(), {});
  const std::string colors = cli::make_color_planet(folder.path());
  const json at = pick(colors, {"--at", "45,0,1000", "--size", "33x33", "--pixel", "16,16"});
  EXPECT_NEAR(at["height_m"].get<double>(), 0.0, 1.0);
  EXPECT_NEAR(at["distance_m"].get<double>(), 1000.0, 1.0);
}

TEST(Pick, RefusesWhatItCannotMeanWithOneLine) {
  const std::vector<std::string> at{"procedural", "--at", "0,0,1000km"};
  cli::expect_refusals(
      "pick", {cli::Refusal{{}, 2}, cli::Refusal{{"procedural", "--pixel", "1,1"}, 2},
               cli::Refusal{with(at, {"--pixel", "1280,0"}), 2},
               cli::Refusal{with(at, {"--pixel", "0.5,0.5"}), 2}, cli::Refusal{with(at, {"--pixel"}), 2},
               cli::Refusal{with(at, {"--pixel", "0,0", "--look", "0,91"}), 2},
               cli::Refusal{with(at, {"--pixel", "0,0", "--detail", "15"}), 2},
               cli::Refusal{with(at, {"--pixel", "0,0", "--time", "noon"}), 2},
               cli::Refusal{{"procedural", "--at", "91,0", "--pixel", "0,0"}, 2},
               cli::Refusal{{"/nowhere", "--at", "0,0", "--pixel", "0,0"}, 1}});
}

}  // namespace
