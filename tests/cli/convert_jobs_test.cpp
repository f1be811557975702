#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/run_program.h"
#include "tests/cli/write_map.h"

// Conversion in parts: by several processes, after an interruption, and when the disk is full.

namespace {

using cli::Outcome;
using cli::run_program;
using tests::TemporaryFolder;

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A folder with maps of heights and colors of 8 jobs each, and the planet that one run makes of them.
class ConvertJobs : public testing::Test {
 protected:
  void SetUp() override {
    cli::write_map(folder_ / "heights.tif", 1024, 512);
    cli::write_map(folder_ / "colors.tif", 1024, 512);
    if (!whole_.empty()) return;
    ASSERT_EQ(run_program(command()).status, 0);
    for (const auto& file : std::filesystem::directory_iterator(planet()))
      whole_[file.path().filename()] = cli::text_of(file.path());
    ASSERT_EQ(whole_.size(), 21U);
    std::filesystem::remove_all(planet());
  }

  std::string planet() const { return (folder_ / "planet").string(); }
  Words command() const {
    return {"convert", (folder_ / "heights.tif").string(), "--color", (folder_ / "colors.tif").string(), "-o",
            planet()};
  }
  void expect_whole() const {
    std::size_t files = 0;
    for (const auto& file : std::filesystem::directory_iterator(planet())) {
      EXPECT_EQ(cli::text_of(file.path()), whole_.at(file.path().filename())) << file.path();
      ++files;
    }
    EXPECT_EQ(files, whole_.size());
    EXPECT_FALSE(std::filesystem::exists(planet() + ".partial"));
  }

  TemporaryFolder folder_;
  static inline std::map<std::string, std::string> whole_;  ///< the files of that planet
};

TEST_F(ConvertJobs, InAnyOrderAndSeveralAtATimeGiveTheBytesOfOneRun) {
  const Outcome list = run_program(command() + Words{"--jobs", "--quiet"});
  ASSERT_EQ(list.status, 0) << list.err;
  Words jobs;
  for (const std::string& line : list.lines()) jobs.push_back(line.substr(0, line.find(' ')));
  ASSERT_EQ(jobs.size(), 16U);
  EXPECT_EQ(list.lines()[3], "3 height 1 1");
  EXPECT_EQ(list.lines()[15], "15 color 3 1");
  EXPECT_FALSE(std::filesystem::exists(planet() + ".partial")) << "listing writes nothing";
  std::shuffle(jobs.begin(), jobs.end(), std::mt19937(7));
  const TemporaryFolder streams[2];
  for (std::size_t k = 0; k < jobs.size(); k += 2) {
    pid_t pair[2];
    for (std::size_t m = 0; m < 2; ++m)
      pair[m] = cli::start(command() + Words{"--job", jobs[k + m], "--threads", "1"}, streams[m].path());
    for (const pid_t child : pair) EXPECT_EQ(cli::wait_for(child), 0);
    EXPECT_EQ(std::filesystem::exists(planet()), k + 2 == jobs.size());
  }
  expect_whole();
}

TEST_F(ConvertJobs, SpreadOverMpiGiveTheBytesOfOneRun) {
  const std::filesystem::path plugin = std::filesystem::path(GLOBE_PROGRAM).parent_path() / "libglobe_mpi.so";
  if (std::system("mpirun --version > /dev/null 2>&1") != 0 || !std::filesystem::exists(plugin))
    GTEST_SKIP() << "SKIPPED: no Open MPI here";
  std::string line =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 3 " GLOBE_PROGRAM;
  for (const std::string& word : command()) line += " '" + word + "'";
  EXPECT_EQ(std::system((line + " --quiet").c_str()), 0);
  expect_whole();
}

TEST_F(ConvertJobs, AConversionGoesOnFromThePartsThatAreDone) {
  for (const char* job : {"0", "7", "14"}) {
    const Outcome one = run_program(command() + Words{"--job", job});
    EXPECT_EQ(one.status, 0) << one.err;
    EXPECT_NE(one.err.find("of 16"), std::string::npos) << one.err;
  }
  const Outcome rest = run_program(command());
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.err.find("3 of 16 parts are done"), std::string::npos) << rest.err;
  expect_whole();
}

TEST_F(ConvertJobs, PartsThatMayNotHaveReachedTheDiskCountUntilTheMachineStartsAnew) {
  for (const char* job : {"0", "7", "14"})
    ASSERT_EQ(run_program(command() + Words{"--job", job, "--quiet"}).status, 0);
  const std::filesystem::path work = planet() + ".partial/work";
  std::string boot = cli::text_of("/proc/sys/kernel/random/boot_id");
  boot.erase(boot.find_last_not_of('\n') + 1);
  const auto mark = [&](const char* name, const std::string& time) {
    const std::string range = cli::text_of(work / name);
    std::ofstream(work / name) << range.substr(0, range.find('\n')) << ' ' << time << '\n';
  };
  mark("height_0_0.done", boot);
  mark("height_3_1.done", "another-time");
  std::ofstream(work / "height_3_1.tif") << "what the power left of it";
  const Outcome rest = run_program(command());
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.err.find("2 of 16 parts are done"), std::string::npos) << rest.err;
  expect_whole();
}

TEST_F(ConvertJobs, WhatIsLeftOfAPlanetThatWasBeingClearedAwayCountsForNothing) {
  for (const char* job : {"2", "3"}) ASSERT_EQ(run_program(command() + Words{"--job", job}).status, 0);
  const std::filesystem::path work = planet() + ".partial/work";
  ASSERT_TRUE(std::filesystem::remove(work / "recipe.json"));
  ASSERT_TRUE(std::filesystem::remove(work / "height_0_1.tif") ||
              std::filesystem::remove(work / "height_1_0.tif"));
  ASSERT_TRUE(std::filesystem::remove(work / "relief.level"));
  const Outcome again = run_program(command());
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.err.find("parts are done"), std::string::npos) << again.err;
  expect_whole();
}

TEST_F(ConvertJobs, ALargeMapIsDecodedOnceForAll) {
  ASSERT_EQ(run_program(command() + Words{"--job", "1"}).status, 0);
  const std::filesystem::path spool = planet() + ".partial/work/height_0.source";
  ASSERT_EQ(std::filesystem::file_size(spool), 1024U * 512U * 4U);
  // What is in the spool is what is converted: another job takes it from there.
  std::fstream(spool, std::ios::in | std::ios::out | std::ios::binary).write("\0\0\0\0", 4);
  const auto changed = std::filesystem::last_write_time(spool);
  ASSERT_EQ(run_program(command() + Words{"--job", "2"}).status, 0);
  EXPECT_EQ(std::filesystem::last_write_time(spool), changed);
  std::filesystem::remove_all(planet() + ".partial");
}

TEST_F(ConvertJobs, AJobOutOfRangeIsRefused) {
  const Outcome one = run_program(command() + Words{"--job", "16", "--quiet"});
  EXPECT_EQ(one.status, 2);
  EXPECT_NE(one.err.find("jobs 0 to 15"), std::string::npos) << one.err;
  EXPECT_FALSE(std::filesystem::exists(planet() + ".partial"));
  EXPECT_EQ(run_program(command() + Words{"--job", "1", "--jobs"}).status, 2);
}

TEST_F(ConvertJobs, OtherOptionsDoNotTouchWhatWasBegun) {
  ASSERT_EQ(run_program(command() + Words{"--job", "3"}).status, 0);
  for (const Words& change :
       {Words{"--filter", "nearest"}, Words{"--scale", "2"}, Words{"--job", "4", "--level", "8"}}) {
    const Outcome other = run_program(command() + change + Words{"--quiet"});
    EXPECT_EQ(other.status, 1) << change.front();
    EXPECT_NE(other.err.find("begun with other maps or options"), std::string::npos) << other.err;
  }
  cli::write_map(folder_ / "heights.tif", 512, 256);  // the same name, another map
  EXPECT_EQ(run_program(command()).status, 1);
  EXPECT_EQ(run_program(command() + Words{"--overwrite"}).status, 0) << "begins anew when told to";
  EXPECT_EQ(run_program({"info", planet(), "--verify"}).status, 0);
}

TEST_F(ConvertJobs, AFullDiskEndsInOneLineAndIsGoneOnFromWhenThereIsRoom) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  std::mt19937 random(20261124);
  const int times = std::getenv("GLOBE_TEST_FULL") != nullptr ? 40 : 5;
  int failed = 0;
  for (int k = 0; k < times; ++k) {
    rlimit less = before;
    less.rlim_cur = std::uniform_int_distribution<rlim_t>(1 << 10, 1 << 20)(random);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &less), 0);
    const Outcome result = run_program(command() + Words{"--quiet"});
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    if (result.status == 0) {
      expect_whole();
      std::filesystem::remove_all(planet());
      continue;
    }
    ++failed;
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("disk"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(planet()));
  }
  EXPECT_GT(failed, 0);
  EXPECT_EQ(run_program(command()).status, 0);
  expect_whole();
}

}  // namespace
