#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

// Effects of scenes through the program: what they cost is told, and what is not named is not there.

namespace {

using cli::Outcome;
using cli::run_program;
using cli::with;
using nlohmann::json;

using Words = std::vector<std::string>;

const std::string kCamera = "[camera]\nat = \"-43.42,-106.43,300\"\nagl = true\nlook = \"110,-10\"\n";
const Words kTiny{"--size", "64x36", "--detail", "16"};

class Effects : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome run =
        run_program(with({"shot", "procedural", "-o", file("probe.png"), "--at", "1 2 1e6"}, kTiny));
    if (run.status != 0) GTEST_SKIP() << "NO GRAPHICS HERE: " << run.err;
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string shot(const std::string& scene, const char* program = GLOBE_PROGRAM) const {
    const Outcome run = run_program(
        with({"shot", scene, "-o", file("shot.png"), "--overwrite", "--quiet"}, kTiny), "", program);
    EXPECT_EQ(run.status, 0) << run.err;
    return cli::text_of(file("shot.png"));
  }

 private:
  tests::TemporaryFolder folder_;
};

TEST_F(Effects, AProgramWithoutAnyDrawsTheSameBytesForScenesThatNameNone) {
  for (const char* place : {"-43.42,-106.43,300", "10,20,1e6"}) {
    const std::string scene = write(
        "plain.toml", "[camera]\nat = \"" + std::string(place) + "\"\nagl = true\nlook = \"110,-10\"\n");
    EXPECT_EQ(shot(scene), shot(scene, GLOBE_WITHOUT_EFFECTS));
  }
  const std::string foggy = write("fog.toml", kCamera + "[effects.fog]\n");
  EXPECT_NE(shot(foggy), shot(write("plain.toml", kCamera)));
  const Outcome refused =
      run_program(with({"shot", foggy, "-o", file("x.png")}, kTiny), "", GLOBE_WITHOUT_EFFECTS);
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find(foggy + ":5: effects.fog: there is no effect \"fog\""), std::string::npos)
      << refused.err;
}

TEST_F(Effects, LeavingOneOutOfTheListChangesNothingOfTheOthers) {
  const std::string others =
      "[effects.contours]\n[effects.sea]\nwind_speed = 7\n[effects.fog]\n[effects.stars]\n";
  const std::string scene = write("others.toml", kCamera + others);
  EXPECT_EQ(shot(scene), shot(scene, GLOBE_WITHOUT_CLOUDS));
  const std::string cloudy = write("cloudy.toml", kCamera + others + "[effects.clouds]\n");
  EXPECT_NE(shot(cloudy), shot(scene));
  const Outcome refused =
      run_program(with({"shot", cloudy, "-o", file("x.png")}, kTiny), "", GLOBE_WITHOUT_CLOUDS);
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("there is no effect \"clouds\""), std::string::npos) << refused.err;
}

TEST_F(Effects, ExplainTellsWhoAskedWhereItWorksAndWhatItCosts) {
  const std::string scene =
      write("s.toml", kCamera + "[sun]\naltitude = \"30 deg\"\nazimuth = \"290 deg\"\n" +
                          "[effects.fog]\nbase = \"1 km\"\n[effects.lens_flare]\n");
  const Outcome run = run_program(with({"explain", scene, "--json", "--rounds", "5", "--quiet"}, kTiny));
  ASSERT_EQ(run.status, 0) << run.err;
  const json plan = json::parse(run.out);
  ASSERT_EQ(plan["effects"].size(), 2u);
  const json& flare = plan["effects"][0];
  EXPECT_EQ(flare["effect"], "lens_flare");
  EXPECT_EQ(flare["asked_by"], scene + ":10");
  EXPECT_EQ(flare["active"], false);
  EXPECT_EQ(flare["why"], "the sun is out of the picture");
  EXPECT_EQ(flare["gpu_bytes"], 0);
  EXPECT_EQ(flare["passes"], 2);
  EXPECT_EQ(flare["in_shaders"], false);
  const json& fog = plan["effects"][1];
  EXPECT_EQ(fog["active"], true);
  EXPECT_EQ(fog["in_shaders"], true);
  EXPECT_GT(fog["gpu_bytes"], 0);
  ASSERT_FALSE(fog["active_above_ground"].empty());
  EXPECT_EQ(fog["active_above_ground"][0]["from_m"], 0.0);
  for (const char* what : {"all", "none"}) {
    EXPECT_GT(plan[what]["median_ms"], 0.0);
    EXPECT_LE(plan[what]["low_ms"], plan[what]["median_ms"]);
    EXPECT_GE(plan[what]["high_ms"], plan[what]["median_ms"]);
  }
  const Outcome text = run_program(with({"explain", scene, "--rounds", "5", "--quiet"}, kTiny));
  EXPECT_NE(text.out.find("no: the sun is out of the picture"), std::string::npos) << text.out;
}

TEST_F(Effects, ATraceTellsWhenAnEffectBecameActiveAndWhy) {
  const std::string scene = write("s.toml", "[effects.stars]\n");
  const Outcome run =
      run_program(with({"fly", scene, "-o", file("f.gif"), "--wait", "--frames", "12", "--quiet", "--trace",
                        file("trace.json"), "--to", "-43.42,-106.43,300", "--agl"},
                       kTiny));
  ASSERT_EQ(run.status, 0) << run.err;
  const json trace = json::parse(cli::text_of(file("trace.json")));
  EXPECT_EQ(trace["frames"], 12);
  ASSERT_EQ(trace["events"].size(), 2u) << trace.dump(1);
  EXPECT_EQ(trace["events"][0]["active"], true);
  EXPECT_EQ(trace["events"][0]["frame"], 0);
  EXPECT_EQ(trace["events"][1]["active"], false);
  EXPECT_EQ(trace["events"][1]["why"], "the sky is too bright");
  EXPECT_LT(trace["events"][1]["alt_m"], 21000.0) << "where the air of the day begins to hide them";
  EXPECT_EQ(trace["effects"][0]["frames_active"], trace["events"][1]["frame"]);
}

TEST_F(Effects, AtTenAndAtSixtyFramesASecondAFlightEndsInTheSamePicture) {
  const std::string scene =
      write("s.toml",
            "[effects.fog]\n[effects.stars]\n[[path.keys]]\ntime = 0\nat = \"-43.42,-106.43,3km\"\n"
            "[[path.keys]]\ntime = 1\nat = \"-43.42,-106.40,2500\"\n[sun]\ntime = "
            "2026-12-21T03:00:00Z\nspeed = 60\n");
  std::vector<std::string> ends;
  for (const char* fps : {"10", "60"}) {
    const std::string folder = file(fps);
    const Outcome run = run_program(
        with({"fly", scene, "-o", folder + "/####.png", "--wait", "--fps", fps, "--quiet"}, kTiny));
    ASSERT_EQ(run.status, 0) << run.err;
    std::string last;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      last = std::max(last, entry.path().string());
    ends.push_back(cli::text_of(last));
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST_F(Effects, WhatCannotBeIsRefusedInOneLine) {
  const std::string unknown = write("unknown.toml", kCamera + "[effects.fgo]\n");
  const std::string negative = write("negative.toml", kCamera + "[effects.fog]\nvisibility = -1\n");
  const std::string flare = write("flare.toml", kCamera + "[effects.lens_flare]\n");
  cli::expect_refusals("shot", {{{unknown, "-o", file("x.png")}, 1},
                                {{negative, "-o", file("x.png")}, 1},
                                {{flare, "--projection", "fisheye", "-o", file("x.png")}, 1}});
  cli::expect_refusals("explain", {{{"procedural"}, 2}, {{unknown}, 1}, {{flare, "--rounds", "0"}, 2}});
}

}  // namespace
