#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "app/view/last_view.h"
#include "app/view/shell_words.h"
#include "app/view/text.h"
#include "globe/base/error.h"
#include "tests/temporary_folder.h"

namespace {

using app::view::LastView;

TEST(LastView, IsRecalledExactlyBesideOthers) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "some/where/views.json";
  const LastView one{
      {{47.123456789012345, -11.1, 1234.5678901234567}, {0.1, -89.9}}, 3.25, "2026-06-21T10:00Z", ""};
  const LastView two{{{-10.0, 20.0, 5.0}, {1.0, 2.0}}, 0.0, "", "0,30"};
  app::view::remember_view(file, "one", one);
  app::view::remember_view(file, "two \"quoted\"", two);
  const auto found = app::view::recall_view(file, "one");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stand.place.lat_deg, one.stand.place.lat_deg);
  EXPECT_EQ(found->stand.place.h_m, one.stand.place.h_m);
  EXPECT_EQ(found->stand.look.pitch_deg, one.stand.look.pitch_deg);
  EXPECT_EQ(found->moment_s, 3.25);
  EXPECT_EQ(found->time, one.time);
  EXPECT_EQ(app::view::recall_view(file, "two \"quoted\"")->overhead, "0,30");
  EXPECT_FALSE(app::view::recall_view(file, "three"));
}

TEST(LastView, ADamagedFileIsAsNone) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "views.json";
  for (const char* text :
       {"", "{", "[1]", R"({"p": 3})", R"({"p": {"lat": 95, "lon": 0, "alt_m": 1}})",
        R"({"p": {"lat": "x", "lon": 0, "alt_m": 1, "heading": 0, "pitch": 0, "moment_s": 0}})",
        R"({"p": {"lat": 1e999, "lon": 0, "alt_m": 1, "heading": 0, "pitch": 0, "moment_s": 0}})"}) {
    std::ofstream(file) << text;
    EXPECT_FALSE(app::view::recall_view(file, "p")) << text;
  }
  app::view::remember_view(file, "p", {});
  EXPECT_TRUE(app::view::recall_view(file, "p"));
}

TEST(LastView, WhatCannotBeWrittenIsTold) {
  EXPECT_THROW(app::view::remember_view("/proc/nothing/views.json", "p", {}), globe::Error);
}

TEST(ShellLine, IsReadBackByAShellAsItWas) {
  const std::vector<std::string> words{"globe",       "shot", "a b", "it's", "", "$HOME `x` \"q\" \\",
                                       "-5,7.25,1e6", "é"};
  const std::string command = "printf '%s\\n' " + app::view::shell_line(words);
  std::FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string out;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
  pclose(pipe);
  std::string expected;
  for (const std::string& word : words) expected += word + "\n";
  EXPECT_EQ(out, expected);
}

TEST(ScreenText, ReadsAsPeopleWriteIt) {
  using namespace app::view;
  EXPECT_EQ(sexagesimal(47.5, 'N', 'S'), "47° 30' 00.0\" N");
  EXPECT_EQ(sexagesimal(-0.9999999, 'N', 'S'), "1° 00' 00.0\" S");
  EXPECT_EQ(length(2.04), "2.0 m");
  EXPECT_EQ(length(9999.4), "9999 m");
  EXPECT_EQ(length(-45678.0), "-45.7 km");
  EXPECT_EQ(length(384400e3), "384400 km");
  EXPECT_EQ(bytes(12.34e6), "12.3 MB");
}

}  // namespace
