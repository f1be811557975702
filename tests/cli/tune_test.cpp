#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

TEST(TuneCommand, PicksTheFastestDetailThatKeepsAnErrorAndWritesItAsPartOfAScene) {
  const tests::TemporaryFolder folder;
  const std::string fragment = (folder / "picture.toml").string();
  const Outcome run = run_program({"tune", "procedural", "--error", "1000", "--size", "128x72", "--details",
                                   "16,32", "--json", "--quiet", "-o", fragment});
  ASSERT_EQ(run.status, 0) << run.err;
  const json answer = json::parse(run.out);
  ASSERT_EQ(answer["measured"].size(), 2u);
  const json &coarse = answer["measured"][0], &fine = answer["measured"][1];
  EXPECT_GT(coarse["error_rms_px"], fine["error_rms_px"]);
  EXPECT_LT(coarse["triangles"], fine["triangles"]);
  for (const json& row : answer["measured"]) {
    EXPECT_LE(row["frame_low_ms"], row["frame_ms"]);
    EXPECT_LE(row["frame_ms"], row["frame_high_ms"]);
  }
  const json& chosen = answer["detail"] == 16 ? coarse : fine;
  EXPECT_LE(chosen["frame_ms"], (answer["detail"] == 16 ? fine : coarse)["frame_ms"]);
  std::ostringstream text;
  text << std::ifstream(fragment).rdbuf();
  EXPECT_NE(text.str().find("[picture]"), std::string::npos);
  EXPECT_NE(text.str().find("detail = " + answer["detail"].dump()), std::string::npos) << text.str();
}

TEST(TuneCommand, SaysWhatComesNearestWhenNothingReachesTheGoal) {
  const Outcome run = run_program(
      {"tune", "procedural", "--error", "0.001", "--size", "128x72", "--details", "16", "--quiet"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
  EXPECT_NE(run.err.find("the nearest is --detail 16"), std::string::npos) << run.err;
}

TEST(TuneCommand, RefusesInOneLine) {
  cli::expect_refusals("tune", {{{"procedural"}, 2},
                                {{"procedural", "--fps", "30", "--error", "1"}, 2},
                                {{"procedural", "--fps", "nan"}, 2},
                                {{"procedural", "--error", "-1"}, 2},
                                {{"procedural", "--fps", "30", "--details", "8"}, 2},
                                {{"procedural", "--fps", "30", "--details", "64,x"}, 2},
                                {{"/nonexistent", "--fps", "30"}, 1}});
}

}  // namespace
