#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::run_program;
using cli::text_of;

/// Small pictures of small ground.
std::vector<std::string> endless(const std::vector<std::string>& more) {
  std::vector<std::string> words{"flat", "endless",  "fractal:7", "--size",       "96x64", "--block",
                                 "3",    "--blocks", "4",         "--iterations", "8",     "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(FlatEndless, APictureIsTheSameBytesEachTimeAndCullingChangesNone) {
  const tests::TemporaryFolder folder;
  const auto picture = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"-o", (folder / name).string(), "--from", "8e9,-8e9"});
    const cli::Outcome run = run_program(endless(more));
    EXPECT_EQ(run.status, 0) << run.err;
    return text_of(folder / name);
  };
  const std::string first = picture("a.png", {});
  EXPECT_GT(first.size(), 1000u);
  EXPECT_EQ(picture("b.png", {}), first);
  EXPECT_EQ(picture("c.png", {"--culling", "off", "--cached-areas", "0"}), first);
  EXPECT_NE(picture("d.png", {"--method", "diamond-square"}), first);
}

TEST(FlatEndless, FramesTellWhatTheyTook) {
  const tests::TemporaryFolder folder;
  const cli::Outcome run =
      run_program(endless({"-o", (folder / "f/####.png").string(), "--frames", "5", "--fps", "1", "--speed",
                           "400", "--stats", (folder / "s.json").string()}));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto stats = nlohmann::json::parse(text_of(folder / "s.json"));
  ASSERT_EQ(stats["frames"].size(), 5u);
  EXPECT_GT(stats["frames"][0]["triangles"], 0);
  EXPECT_EQ(stats["summary"]["frames"], 5);
  EXPECT_GT(stats["summary"]["pagings"], 1);
  EXPECT_GT(stats["summary"]["area_hits"], 0);
  EXPECT_GT(text_of(folder / "f/0004.png").size(), 1000u);
}

TEST(FlatEndless, RefusesWhatItCannotDo) {
  const tests::TemporaryFolder folder;
  const std::string out = (folder / "x.png").string();
  cli::expect_refusals("flat", {{{"endless", "fractals", "-o", out}, 2},
                                {{"endless", "fractal:x", "-o", out}, 2},
                                {{"endless", "-o", out, "--from", "1"}, 2},
                                {{"endless", "-o", out, "--rings", "1000,1001"}, 2},
                                {{"endless", "-o", out, "--rings", "nan,1"}, 2},
                                {{"endless", "-o", out, "--frames", "2"}, 2},
                                {{"endless", "-o", out, "--block", "6", "--blocks", "8"}, 2},
                                {{"endless", "-o", out, "--from", "1e12,0", "--area", "0.001"}, 2}});
}

}  // namespace
