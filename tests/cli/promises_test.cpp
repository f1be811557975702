#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

// What README and COMMANDS promise of the program as a whole.

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;
using tests::TemporaryFolder;

void expect_one_line(const Outcome& run, int status, const std::string& part) {
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.substr(0, 7), "globe: ");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

/// Sets a variable of the environment for the life of the object.
class Setting {
 public:
  Setting(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~Setting() { old_.empty() ? unsetenv(name_) : setenv(name_, old_.c_str(), 1); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
  std::string old_;
};

/// Words of a flight of four small pictures, each complete, and what the caller adds.
std::vector<std::string> flight(const std::vector<std::string>& more) {
  std::vector<std::string> words{"fly",    "procedural", "--to",     "10 20", "--frames", "4",
                                 "--size", "160x90",     "--detail", "16",    "--wait",   "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Program, HelpNamesEverySubcommand) {
  const Outcome run = run_program({"--help"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  for (const char* command : {"convert", "fly", "shot", "info", "lookup", "trixel", "height"}) {
    EXPECT_NE(run.out.find(command), std::string::npos) << command;
    const Outcome help = run_program({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_NE(help.out.find("--"), std::string::npos) << command;
  }
  EXPECT_EQ(run_program({"-h"}).out, run.out);
}

TEST(Program, DrawsAPlanetOfColorsAlone) {
  const TemporaryFolder folder;
  cli::make_planet(folder.path(), {});
  const std::string colors = cli::make_color_planet(folder.path());
  const std::string picture = (folder / "view.png").string();
  const Outcome run = run_program(
      {"shot", colors, "-o", picture, "--at", "10 20 50000", "--size", "64x32", "--detail", "16", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST(Program, TellsItsVersion) {
  const Outcome run = run_program({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out.substr(0, 6), "globe ");
  EXPECT_EQ(run.lines().size(), 1u);
  const Setting started("GLOBE_TEST_FULL", "1");  // the other tests may run its code without starting it
  const Outcome again = run_program({"--version"});
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.out, run.out);
  EXPECT_EQ(run_program({"--frobnicate"}).status, 2);
}

TEST(Program, RefusesUnknownWordsWithOneLineAndStatus2) {
  expect_one_line(run_program({}), 2, "globe --help");
  expect_one_line(run_program({"--frobnicate"}), 2, "globe --help");
  expect_one_line(run_program({"lookup", "--frobnicate", "1 2"}), 2, "frobnicate");
  expect_one_line(run_program({"shot", "procedural", "-o", "x.png"}), 2, "--at");
  expect_one_line(run_program({"fly", "procedural", "-o", "x.mp4", "--size", "huge"}), 2, "--size");
  expect_one_line(run_program({"fly", "procedural", "-o", "x.mp4", "--positions", "double"}), 2,
                  "--positions");
  for (const char* budget : {"-1", "nan", "1e9", "soon"})
    expect_one_line(run_program({"fly", "procedural", "-o", "x.mp4", "--budget", budget}), 2, "--budget");
  for (const char* option : {"--fov", "--exaggeration"})
    for (const char* value : {"nan", "inf", "-1", "1e9", "60deg"})
      expect_one_line(run_program({"shot", "procedural", "-o", "x.png", "--at", "0 0", option, value}), 2,
                      option);
  expect_one_line(run_program({"fly", "procedural", "-o", "x.mp4", "--fps", "nan"}), 2, "--fps");
  expect_one_line(run_program({"fly", "procedural", "-o", "x.mp4", "--memory", "3"}), 2, "--memory");
  expect_one_line(run_program({"shot", "procedural", "-o", "x.png", "--at", "0 0", "--window", "round"}), 2,
                  "--window");
}

TEST(Program, SaysInOneLineThatThereIsNoGraphics) {
  const TemporaryFolder folder;
  const std::string picture = (folder / "x.png").string();
  const Setting no_vendor("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent");
  const Setting no_platform("EGL_PLATFORM", "surfaceless");
  expect_one_line(run_program({"shot", "procedural", "-o", picture, "--at", "1 2 1000", "--size", "64x32"}),
                  1, "OpenGL");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

class Pictures : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome run = run_program({"shot", "procedural", "-o", (folder_ / "probe.png").string(), "--at",
                                     "1 2 1e6", "--size", "32x16", "--detail", "16"});
    if (run.status != 0) GTEST_SKIP() << "NO GRAPHICS HERE: " << run.err;
    std::filesystem::remove(folder_ / "probe.png");
  }

  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      found.insert(entry.path().filename().string());
    return found;
  }

  TemporaryFolder folder_;
};

TEST_F(Pictures, ShotRefusesToOverwriteUnlessTold) {
  const std::string picture = (folder_ / "x.png").string();
  const std::vector<std::string> words{"shot",    "procedural", "-o",    picture,    "--at",
                                       "1 2 1e6", "--size",     "32x16", "--detail", "16"};
  EXPECT_EQ(run_program(words).status, 0);
  const std::string first = cli::text_of(picture);
  expect_one_line(run_program(words), 1, "exists");
  EXPECT_EQ(cli::text_of(picture), first);
  std::vector<std::string> overwrite = words;
  overwrite.push_back("--overwrite");
  EXPECT_EQ(run_program(overwrite).status, 0);
  EXPECT_EQ(cli::text_of(picture), first) << "the same picture, byte for byte";
}

TEST_F(Pictures, FlightsAreTheSameBytesTwiceWithWait) {
  for (const char* name : {"a", "b"}) {
    const Outcome run = run_program(flight({"-o", (folder_ / name / "####.png").string()}));
    ASSERT_EQ(run.status, 0) << run.err;
  }
  for (const char* frame : {"0000.png", "0001.png", "0002.png", "0003.png"}) {
    const std::string a = cli::text_of(folder_ / "a" / frame);
    EXPECT_GT(a.size(), 100u);
    EXPECT_EQ(a, cli::text_of(folder_ / "b" / frame)) << frame;
  }
  EXPECT_NE(cli::text_of(folder_ / "a/0000.png"), cli::text_of(folder_ / "a/0003.png"));
}

TEST_F(Pictures, StatisticsHaveTheKeysOfTheContract) {
  const std::string stats = (folder_ / "s.json").string();
  ASSERT_EQ(run_program(flight({"-o", (folder_ / "####.png").string(), "--stats", stats})).status, 0);
  const json document = json::parse(cli::text_of(stats));
  const auto keys = [](const json& object) {
    std::set<std::string> found;
    for (const auto& item : object.items()) found.insert(item.key());
    return found;
  };
  EXPECT_EQ(keys(document), (std::set<std::string>{"renderer", "gl_version", "width", "height", "detail",
                                                   "planet_level", "frames", "summary"}));
  ASSERT_EQ(document["frames"].size(), 4u);
  for (const json& frame : document["frames"]) {
    EXPECT_EQ(keys(frame), (std::set<std::string>{"frame", "lat", "lon", "alt_m", "above_ground_m",
                                                  "frame_ms", "cpu_ms", "gpu_ms", "triangles", "patches",
                                                  "upload_bytes", "upload_ms", "queued_jobs", "queued_bytes",
                                                  "gpu_bytes", "finest_level", "completeness", "complete"}));
    EXPECT_TRUE(frame["complete"].get<bool>());
    EXPECT_EQ(frame["completeness"].get<double>(), 1.0);
    EXPECT_GT(frame["gpu_bytes"].get<double>(), 0.0);
    EXPECT_LE(frame["upload_ms"].get<double>(), frame["frame_ms"].get<double>());
  }
  EXPECT_EQ(document["width"], 160);
}

TEST_F(Pictures, FlightsInRealTimeUploadWithinWhateverBudget) {
  for (const char* budget : {"0", "1000"}) {
    const std::string stats = (folder_ / "s.json").string();
    auto words = flight({"-o", "-", "--stats", stats, "--overwrite", "--budget", budget, "--memory", "64"});
    words[5] = "20";
    std::erase(words, "--wait");
    ASSERT_EQ(run_program(words).status, 0);
    const json document = json::parse(cli::text_of(stats));
    std::size_t uploaded = 0;
    for (const json& frame : document["frames"]) {
      uploaded += frame["upload_bytes"].get<std::size_t>();
      EXPECT_GT(frame["completeness"].get<double>(), 0.0);
      EXPECT_LE(frame["completeness"].get<double>(), 1.0);
    }
    EXPECT_GT(uploaded, 0u) << budget;
  }
}

TEST_F(Pictures, FlightsToStandardOutputAreY4m) {
  const Outcome run = run_program(flight({"-o", "-"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string header = run.out.substr(0, run.out.find('\n'));
  EXPECT_EQ(header.substr(0, 10), "YUV4MPEG2 ") << header;
  for (const char* part : {" W160", " H90", " F30:1", " C444"})
    EXPECT_NE(header.find(part), std::string::npos) << header;
  const std::size_t frame = std::string("FRAME\n").size() + 3u * 160u * 90u;
  EXPECT_EQ(run.out.size(), header.size() + 1 + 4 * frame);
  EXPECT_EQ(run.out.substr(header.size() + 1, 6), "FRAME\n");
}

TEST_F(Pictures, AFlightThatIsKilledLeavesNothingUnderAFinalName) {
  const TemporaryFolder streams;
  const std::string film = (folder_ / "film.mp4").string();
  auto words = flight({"-o", film, "--stats", (folder_ / "s.json").string()});
  words[5] = "100000";
  const pid_t child = cli::start(words, streams.path());
  std::this_thread::sleep_for(std::chrono::seconds(2));
  ::kill(child, SIGKILL);
  const int status = cli::wait_for(child);
  if (status == 1) GTEST_SKIP() << "NO FFMPEG HERE: " << cli::text_of(streams / "stderr");
  EXPECT_EQ(status, 128 + SIGKILL);
  for (const std::string& name : names()) EXPECT_EQ(name.front(), '.') << name;
}

}  // namespace
