#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

// People's own marks through the program: --shapes, --graticule and --labels, and the same in scenes.

namespace {

using cli::Outcome;
using cli::run_program;
using cli::with;

using Words = std::vector<std::string>;

const Words kSmallMarks{"--size", "128x72", "--detail", "16", "--quiet", "--overwrite"};
const Words kAbove{"--at", "-43.42,-106.43,400", "--agl", "--look", "110,-30"};
const std::string kField =
    R"({"type":"Feature","properties":{"name":"Field"},"geometry":{"type":"Polygon","coordinates":)"
    R"([[[-106.428,-43.42],[-106.42,-43.42],[-106.42,-43.426],[-106.428,-43.426],[-106.428,-43.42]]]}})";

class Marks : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome run =
        run_program(with({"shot", "procedural", "-o", file("probe.png"), "--at", "1 2 1e6"}, kSmallMarks));
    if (run.status != 0) GTEST_SKIP() << "NO GRAPHICS HERE: " << run.err;
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string shot(const Words& words) const {
    const Outcome run = run_program(
        with(with({"shot", "procedural", "-o", file("shot.png")}, words), with(kSmallMarks, kAbove)));
    EXPECT_EQ(run.status, 0) << run.err;
    return cli::text_of(file("shot.png"));
  }

 private:
  tests::TemporaryFolder folder_;
};

TEST_F(Marks, EachOptionShowsInThePicture) {
  const std::string field = write("field.geojson", kField);
  const std::string none = shot({}), shapes = shot({"--shapes", field, "--labels", "off"}),
                    named = shot({"--shapes", field}), lines = shot({"--graticule", "--labels", "off"}),
                    narrow = shot({"--graticule", "0.001", "--labels", "off"});
  EXPECT_TRUE(shapes != none);
  EXPECT_TRUE(named != shapes);
  EXPECT_TRUE(lines != none);
  EXPECT_TRUE(narrow != lines);
  EXPECT_TRUE(shot({"--labels", "off"}) == none);
}

TEST_F(Marks, WhatIsOutOfViewLeavesThePictureAsItIs) {
  const std::string far = write("far.geojson", R"({"type":"LineString","coordinates":[[10,20],[11,21]]})");
  EXPECT_TRUE(shot({"--shapes", far}) == shot({}));
}

TEST_F(Marks, AScenesTablesAndTheOptionsDrawTheSame) {
  write("field.geojson", kField);
  const std::string scene =
      write("scene.toml", "[effects.shapes]\nfile = \"field.geojson\"\ncolor = \"ffd133\"\n");
  const Outcome run = run_program(with(with({"shot", scene, "-o", file("scene.png")}, kSmallMarks), kAbove));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(cli::text_of(file("scene.png")) ==
              shot({"--shapes", file("field.geojson"), "--labels", "off"}));
}

TEST_F(Marks, ACoverDrapesAsItIs) {
  const Outcome cover = run_program({"cover", "--cone", "-43.4,-106.4,3km", "--level", "14", "--geojson"});
  ASSERT_EQ(cover.status, 0) << cover.err;
  EXPECT_TRUE(shot({"--shapes", write("cover.geojson", cover.out)}) != shot({}));
}

TEST_F(Marks, FlightsTakeThemToo) {
  const std::string field = write("field.geojson", kField);
  const Outcome fly = run_program(with({"fly", "procedural", "-o", file("##.png"), "--frames", "2", "--wait",
                                        "--shapes", field, "--graticule"},
                                       {"--size", "64x36", "--detail", "16", "--quiet", "--overwrite"}));
  EXPECT_EQ(fly.status, 0) << fly.err;
}

TEST_F(Marks, RefusesInOneLineWhatMakesNoSense) {
  const auto asked = [&](const Words& words) {
    return with(with({"procedural", "-o", file("x.png")}, words), with(kSmallMarks, kAbove));
  };
  const std::string cut = write("cut.geojson", kField.substr(0, 100)),
                    empty = write("empty.geojson", R"({"type":"FeatureCollection","features":[]})"),
                    odd = write("odd.geojson", R"({"type":"Circle","coordinates":[1,2]})"),
                    north = write("north.geojson", R"({"type":"Point","coordinates":[1,91]})"),
                    large = write("large.geojson", R"({"type":"Point","coordinates":[1e999,1]})"),
                    far = write("far.geojson", R"({"type":"LineString","coordinates":[[1e9,1],[2,3]]})");
  std::vector<cli::Refusal> refusals{{asked({"--graticule", "7"}), 2},   {asked({"--graticule", "x"}), 2},
                                     {asked({"--graticule", "-1"}), 2},  {asked({"--labels", "on"}), 2},
                                     {asked({"--labels", "maybe"}), 2},  {asked({"--shapes", file("no")}), 1},
                                     {asked({"--shapes", file(".")}), 1}};
  for (const std::string& name : {cut, empty, odd, north, large, far})
    refusals.push_back({asked({"--shapes", name}), 1});
  cli::expect_refusals("shot", refusals);
  const std::string scene = write("scene.toml", "[effects.labels]\n");
  const Outcome run = run_program(with(with({"shot", scene, "-o", file("x.png")}, kSmallMarks), kAbove));
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("scene.toml:1: effects.labels"), std::string::npos) << run.err;
}

}  // namespace
