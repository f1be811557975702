#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
                               "--stats", folder.path() / "s.json", "--quiet"}));
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
