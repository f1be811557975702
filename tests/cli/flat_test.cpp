#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;

/// A little region of the built-in planet.
std::vector<std::string> flat(const std::string& verb, const std::vector<std::string>& more) {
  std::vector<std::string> words{"flat",   verb,  "procedural", "--center", "46,7",
                                 "--side", "4km", "--spacing",  "60m"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Flat, AShotIsAPictureOfTheSizeAskedForAndTellsItsTriangles) {
  const tests::TemporaryFolder folder;
  const std::string file = folder.path() / "a.png";
  const Outcome run = run_program(flat("shot", {"-o", file, "--size", "160x90"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("triangles in"), std::string::npos);
  const auto image = OIIO::ImageInput::open(file);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->spec().width, 160);
  EXPECT_EQ(image->spec().height, 90);
  EXPECT_EQ(folder.contents(), std::set<std::string>{"a.png"});
}

TEST(Flat, TheSameWordsGiveTheSameBytes) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"a.png", "b.png"})
    ASSERT_EQ(run_program(flat("shot", {"-o", folder.path() / name, "--size", "160x90", "--materials", "on",
                                        "--cloud-shadows", "0.5", "--quiet"}))
                  .status,
              0);
  EXPECT_EQ(cli::text_of(folder.path() / "a.png"), cli::text_of(folder.path() / "b.png"));
}

TEST(Flat, AFlightHasItsFramesAndTheirFigures) {
  const tests::TemporaryFolder folder;
  const Outcome run =
      run_program(flat("fly", {"-o", folder.path() / "f" / "####.png", "--size", "160x90", "--frames", "3",
                               "--to", "46.005,7.005", "--stats", folder.path() / "s.json", "--quiet"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "f" / "0002.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "f" / "0003.png"));
  const auto stats = nlohmann::json::parse(cli::text_of(folder.path() / "s.json"));
  ASSERT_EQ(stats["frames"].size(), 3u);
  EXPECT_GT(stats["frames"][2]["triangles"], 0);
  EXPECT_NEAR(stats["frames"][2]["above_ground_m"].get<double>(), 200.0, 1.0);
}

TEST(Flat, VisibleSetsAreOfTheRegionTheyWereMadeFor) {
  const tests::TemporaryFolder folder;
  const std::string sets = folder.path() / "a.pvs";
  const Outcome made = run_program(flat("pvs", {"-o", sets}));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("16 patches"), std::string::npos) << made.out;
  const std::vector<std::string> shot{"-o", folder.path() / "a.png", "--size", "160x90", "--overwrite"};
  auto words = flat("shot", shot);
  words.insert(words.end(), {"--pvs", sets});
  EXPECT_EQ(run_program(words).status, 0);
  words.insert(words.end(), {"--exaggeration", "2"});
  const Outcome other = run_program(words);
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("was made for another region; make it again by globe flat pvs"),
            std::string::npos);
}

/// A scene with a region, the camera over it or beside.
std::string region_scene(const tests::TemporaryFolder& folder, const std::string& more = "") {
  std::string file = folder.path() / "s.toml";
  std::ofstream(file) << "planet = 'procedural'\n[camera]\nat = '-43.42,-106.43,900'\nagl = true\n"
                         "look = '110,-35'\n[region]\ncenter = '-43.43,-106.41'\nside = '4 km'\n"
                         "spacing = '20 m'\n"
                      << more;
  return file;
}

TEST(FlatInAGlobe, APictureOfASceneHasItsRegionAndPickKnowsWhereItIs) {
  const tests::TemporaryFolder folder;
  const std::string scene = region_scene(folder), depth = folder.path() / "d.exr";
  ASSERT_EQ(
      run_program({"shot", scene, "-o", depth, "--show", "depth", "--size", "320x180", "--quiet"}).status, 0);
  const auto image = OIIO::ImageInput::open(depth);
  ASSERT_TRUE(image);
  std::vector<float> metres(320 * 180 * static_cast<std::size_t>(image->spec().nchannels));
  ASSERT_TRUE(image->read_image(0, 0, 0, image->spec().nchannels, OIIO::TypeDesc::FLOAT, metres.data()));
  int of_region = 0;
  for (const auto& [x, y] :
       {std::pair(160, 90), std::pair(40, 150), std::pair(300, 100), std::pair(160, 20)}) {
    const Outcome picked = run_program({"pick", scene, "--size", "320x180", "--pixel",
                                        std::to_string(x) + "," + std::to_string(y), "--json"});
    ASSERT_EQ(picked.status, 0) << picked.err;
    const auto point = nlohmann::json::parse(picked.out);
    // Depth counts along the camera's axis: tangents of the field of view's halves, 60 degrees high.
    const double up = std::tan(std::numbers::pi / 6.0) * (1.0 - 2.0 * (y + 0.5) / 180.0);
    const double right = std::tan(std::numbers::pi / 6.0) * 16.0 / 9.0 * (2.0 * (x + 0.5) / 320.0 - 1.0);
    const double along = point["distance_m"].get<double>() / std::sqrt(1.0 + up * up + right * right);
    const auto k = static_cast<std::size_t>(y * 320 + x) * static_cast<std::size_t>(image->spec().nchannels);
    EXPECT_NEAR(static_cast<double>(metres[k]) / along, 1.0, 0.01) << x << ',' << y;
    of_region += point["level"] == 19;  // whose nodes are as close as the posts
  }
  EXPECT_GE(of_region, 2);
}

TEST(FlatInAGlobe, AFlightAndAPlanHaveItToo) {
  const tests::TemporaryFolder folder;
  const std::string scene = region_scene(folder);
  const Outcome flown =
      run_program({"fly", scene, "--from", "-43.42,-106.46,1500", "--to", "-43.43,-106.41,3", "--agl",
                   "--frames", "4", "--wait", "--size", "160x90", "-o", folder.path() / "f" / "####.png",
                   "--stats", folder.path() / "s.json", "--quiet"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const auto stats = nlohmann::json::parse(cli::text_of(folder.path() / "s.json"));
  for (const auto& frame : stats["frames"]) EXPECT_GE(frame["above_ground_m"], 1.99);
  const Outcome planned = run_program({"explain", scene, "--size", "160x90", "--rounds", "5", "--json"});
  ASSERT_EQ(planned.status, 0) << planned.err;
  const auto plan = nlohmann::json::parse(planned.out);
  EXPECT_GT(plan["region"]["patches"], 10);
  EXPECT_GT(plan["region"]["triangles"], 100);
}

TEST(FlatInAGlobe, ARegionTooWideForASmallBodyIsRefusedInOneLine) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {"--ellipsoid", "200000,0"});
  const std::string scene = folder.path() / "s.toml";
  for (const auto& [side, status] : {std::pair("150 km", 1), std::pair("20 km", 0)}) {
    std::ofstream(scene)
        << "planet = 'planet'\n[camera]\nat = '10,20,30km'\n[region]\ncenter = '10,20'\nside = '" << side
        << "'\nspacing = '" << (status == 0 ? "200 m" : "1 km") << "'\n";
    const Outcome run = run_program({"shot", scene, "-o", folder.path() / (std::to_string(status) + ".png"),
                                     "--size", "160x90", "--quiet"});
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(run.err.find("is too wide for the planet; give a side of 1.4e+05 m") != std::string::npos,
              status == 1)
        << run.err;
  }
}

TEST(FlatInAGlobe, TheSameSceneIsARegionAlone) {
  const tests::TemporaryFolder folder;
  const Outcome alone =
      run_program({"flat", "shot", region_scene(folder, "[effects.fog]\nvisibility = '9 km'\n"), "-o",
                   folder.path() / "a.png", "--size", "160x90"});
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_NE(alone.err.find("of 144 patches"), std::string::npos) << alone.err;  // 4 km of 12 by 12
  EXPECT_NE(alone.err.find("effects.fog: not drawn over a region alone"), std::string::npos) << alone.err;
}

TEST(Flat, RefusesInOneLine) {
  cli::expect_refusals(
      "flat",
      {{{"shot", "no-such.tif", "-o", "x.png"}, 1},
       {{"shot", "procedural", "-o", "x.png"}, 2},
       {{"shot", "procedural", "--center", "46,7", "-o", "x.png", "--look", "1"}, 2},
       {{"shot", "procedural", "--center", "46,7", "-o", "x.png", "--error", "-1"}, 2},
       {{"shot", "procedural", "--center", "46,7", "-o", "x.png", "--morph", "on"}, 2},
       {{"shot", "procedural", "--center", "46,7", "--side", "0km", "-o", "x.png"}, 2},
       {{"shot", "procedural", "--center", "46,7", "--side", "100m", "--spacing", "60m", "-o", "x.png"}, 1},
       {{"shot", "procedural", "--center", "46,7", "--spacing", "1m", "-o", "x.png"}, 2},
       {{"fly", "procedural", "--center", "46,7", "--frames", "0", "-o", "x.mp4"}, 2}});
}

}  // namespace
