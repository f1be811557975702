#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/make_planet.h"
#include "tests/cli/run_program.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

json lookup(const std::string& point) { return json::parse(run_program({"lookup", "--json", point}).out); }

TEST(Lookup, AnswersAllKeysOfTheContract) {
  const Outcome run = run_program({"lookup", "--json", "50.0875 14.4213"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(
      run.out,
      R"({"lat":50.0875,"lon":14.4213,"level":20,"id":17329681381370,"name":"N330023201200023133322",)"
      R"("diamond":0,"i":430133,"j":98486,"ecef_m":[3971202.6138086873,1021205.3189759327,4869039.347821901],)"
      R"("utm":"33n 458601.709 5548519.788","mgrs":"33UVR5860148519"})"
      "\n");
}

TEST(Lookup, AgreesWithSkyServer) {
  EXPECT_EQ(lookup("16.22908364,287.87029928")["name"], "N023330222213310122202");
  EXPECT_EQ(lookup("-53.49629596,223.95814592")["id"], 12043250829178);
}

TEST(Lookup, TakesTheLevel) {
  EXPECT_EQ(run_program({"lookup", "--level", "0", "10 10"}).out, "10 10 0 15 N3 0 0 0\n");
  EXPECT_EQ(run_program({"lookup", "10 10", "--level=3"}).out, "10 10 3 995 N3203 0 6 0\n");
  for (const char* level : {"-1", "29", "x", "1.5"}) {
    const Outcome run = run_program({"lookup", "--level", level, "10 10"});
    EXPECT_EQ(run.status, 2) << level;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err.substr(0, 7), "globe: ");
  }
}

TEST(Lookup, TakesNegativeCoordinatesAsOperands) {
  for (const char* point : {"-12.5 40", "-12.5,40", "-12.5, 40", "  -12.5   40 "})
    EXPECT_EQ(run_program({"lookup", point}).out.substr(0, 8), "-12.5 40") << point;
  EXPECT_EQ(run_program({"lookup", "-.5,-40"}).out.substr(0, 8), "-0.5 -40");
  EXPECT_EQ(run_program({"lookup", "12,-40", "--level", "3", "-1,-2", "-.5 3"}).lines().size(), 3u);
}

TEST(Lookup, ReadsEveryNotation) {
  struct Row {
    const char* point;
    double lat, lon, tolerance_deg;
  };
  constexpr double kSame = 0.0, kRounding = 1e-9, kMetre = 1.1e-5;
  for (const Row& row : {Row{"40d26'46\"N 79d58'56\"W", 40 + 26 / 60.0 + 46 / 3600.0,
                             -79 - 58 / 60.0 - 56 / 3600.0, kRounding},
                         Row{"79:58:56W,40:26:46N", 40.446111111, -79.982222222, kRounding},
                         Row{"40.5N 80W", 40.5, -80, kSame},
                         Row{"W80 N40.5", 40.5, -80, kSame},
                         Row{"-40.5 E80", -40.5, 80, kSame},
                         Row{"1e-7 45", 1e-7, 45, kSame},
                         Row{"45 1E-7", 45, 1e-7, kSame},
                         Row{"45N 1e-7", 45, 1e-7, kSame},
                         Row{"1e-7N 45", 1e-7, 45, kSame},
                         Row{"1e-7e 45n", 45, 1e-7, kSame},
                         Row{"+45,+3", 45, 3, kSame},
                         Row{"33N 500000 4000000", 36.144718098818, 15, kRounding},
                         Row{"33north 500000 4000000", 36.144718098818, 15, kRounding},
                         Row{"33S 500000 6000000", -36.1447180988, 15, kRounding},
                         Row{"n 2000000 2000000", 90, -180, kSame},
                         Row{"33TWN8000090000", 47.758407117, 16.067488859, kRounding},
                         Row{"33T WN 80000 90000", 47.758407117, 16.067488859, kRounding},
                         Row{"33twn 80000 90000", 47.758407117, 16.067488859, kRounding},
                         Row{"33TWN 8000090000", 47.758407117, 16.067488859, kRounding},
                         Row{"33UVR5860148519", 50.0875, 14.4213, kMetre}}) {
    const json answer = lookup(row.point);
    ASSERT_TRUE(answer.contains("lat")) << row.point << ": " << answer;
    EXPECT_NEAR(answer["lat"].get<double>(), row.lat, row.tolerance_deg) << row.point;
    EXPECT_NEAR(answer["lon"].get<double>(), row.lon, row.tolerance_deg) << row.point;
  }
}

TEST(Lookup, RaisesThePointByItsAlt) {
  const auto height = [](const std::string& point) {
    return lookup(point)["ecef_m"][0].get<double>() - 6378137;
  };
  EXPECT_EQ(height("0 0"), 0);
  EXPECT_EQ(height("0 0 100"), 100);
  EXPECT_EQ(height("0,0,2km"), 2000);
  EXPECT_EQ(height("0 0 2 km"), 2000);
  EXPECT_EQ(height("0 0 -1nmi"), -1852);
  EXPECT_NEAR(height("0N 0E 1000ft"), 304.8, 1e-9);
  EXPECT_NEAR(height("0 0 1e-1mi"), 160.9344, 1e-9);
}

TEST(Lookup, FoldsLongitudesOfAnySize) {
  for (const char* point : {"7 180", "7 -180", "7 540", "7 -36180"})
    EXPECT_EQ(lookup(point)["lon"].get<double>(), -180.0) << point;
  EXPECT_EQ(lookup("7 190")["lon"].get<double>(), -170.0);
  EXPECT_EQ(lookup("7 360.25")["id"], lookup("7 0.25")["id"]);
  EXPECT_EQ(lookup("90 12")["id"], lookup("90 -170")["id"]);
}

TEST(Lookup, RoundsToThePrecisionAndStaysInRange) {
  EXPECT_EQ(run_program({"lookup", "--precision", "3", "1.23456 179.99996"}).out.substr(0, 15),
            "1.235 -180.000 ");
  EXPECT_EQ(run_program({"lookup", "--precision", "0", "-0.2 0.2"}).out.substr(0, 4), "0 0 ");
  const json answer =
      json::parse(run_program({"lookup", "--json", "--precision", "2", "1.23456 -0.001"}).out);
  EXPECT_EQ(answer["lat"].get<double>(), 1.23);
  EXPECT_EQ(answer["lon"].dump(), "0.0");
}

TEST(Lookup, AnswersBadPointsOnTheirOwnLineAndGoesOn) {
  for (const char* point : {"91 0",
                            "-90.0000001 0",
                            "nan 0",
                            "0 nan",
                            "inf 0",
                            "0 -inf",
                            "",
                            " ",
                            "12",
                            "1 2 3 4",
                            "1,,2",
                            ",1,2",
                            "1,2,",
                            "1e999 0",
                            "north pole",
                            "40N 41N",
                            "10E 20W",
                            "0x10 5",
                            "1e-7d 4",
                            "1 2 3parsecs",
                            "1 2 km",
                            "33N 5 nan",
                            "99N 500000 4000000",
                            "33TWN800009000",
                            "33T WN 800 90000",
                            "1 2 nan",
                            "40d70'N 3E",
                            "1;2",
                            "bad",
                            "33TWN",
                            "33T WN 8 0000 9000"}) {
    const Outcome run = run_program({"lookup", point, "1 2"});
    const auto lines = run.lines();
    ASSERT_EQ(lines.size(), 2u) << point << ": " << run.out << run.err;
    EXPECT_EQ(lines[0].substr(0, 7), "ERROR: ") << point;
    EXPECT_EQ(lines[1].substr(0, 4), "1 2 ") << point;
  }
}

TEST(Lookup, ExitsWith1WhenARecordWasBadAnd0OtherwiseAndStrictStops) {
  EXPECT_EQ(run_program({"lookup", "1 2", "x"}).status, 1);
  EXPECT_EQ(run_program({"lookup", "1 2"}).status, 0);
  EXPECT_EQ(run_program({"lookup"}, "").status, 0);
  const Outcome strict = run_program({"lookup", "--strict", "1 2", "x", "3 4"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_EQ(strict.lines().size(), 2u);
}

TEST(Lookup, ReadsRecordsFromStandardInputAndPassesCommentsThrough) {
  const Outcome run = run_program({"lookup", "--level", "1"}, "# a comment\n10 10\r\n\nbad\n-5,20");
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "# a comment");
  EXPECT_EQ(lines[1], "10 10 1 62 N32 0 1 0");
  EXPECT_EQ(lines[2], "");
  EXPECT_EQ(lines[3].substr(0, 7), "ERROR: ");
  EXPECT_EQ(lines[4].substr(0, 6), "-5 20 ");
}

TEST(Lookup, NumbersABinaryLineInItsPlaceAndStaysText) {
  const std::string input = std::string("1 2\n") + "\xff\x80" + '\0' + "\x01\n" + "\xff\x80\n3 4\n";
  for (const std::string format : {"", "--csv", "--json"}) {
    std::vector<std::string> words{"lookup"};
    if (!format.empty()) words.push_back(format);
    const Outcome run = run_program(words, input);
    EXPECT_EQ(run.status, 1);
    auto lines = run.lines();
    if (format == "--csv") lines.erase(lines.begin());
    ASSERT_EQ(lines.size(), 4u) << run.out;
    const std::string begin = format.empty()      ? "ERROR: line "
                              : format == "--csv" ? "\"ERROR: line "
                                                  : R"({"line":)";
    for (const std::size_t bad : {1u, 2u}) {
      EXPECT_TRUE(lines[bad].starts_with(begin + std::to_string(bad + 1))) << lines[bad];
      EXPECT_NE(lines[bad].find("; "), std::string::npos) << "without what to do: " << lines[bad];
      EXPECT_NO_THROW(nlohmann::json(lines[bad]).dump()) << "not UTF-8";
    }
    EXPECT_EQ(run.out.find('\xff'), std::string::npos);
  }
}

TEST(Lookup, NumbersTheLinesOfBadRecordsInJson) {
  const Outcome run = run_program({"lookup", "--json"}, "# a comment\n\n1 2\nbad \"one\"\n");
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(json::parse(lines[0])["lat"], 1.0);
  const json error = json::parse(lines[1]);
  EXPECT_EQ(error["line"], 4);
  EXPECT_TRUE(error["error"].is_string());
}

TEST(Lookup, KeepsOneLineARecordWhateverBytesComeIn) {
  const std::string huge(200'000, '7');
  const Outcome run = run_program({"lookup", "--json"}, "\xff\xfe 1\n" + huge + "\n\x01\x02\n1 2\n");
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 4u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(json::parse(lines[k]).contains("error"));
  EXPECT_TRUE(json::parse(lines[3]).contains("id"));
  EXPECT_EQ(run_program({"lookup", "1\n2\n3\n4\n5"}).lines().size(), 1u);
}

/// 30,000 records, more than are read at once; those that `is_bad` picks are none.
template <typename IsBad>
std::string many_records(IsBad is_bad) {
  std::string text;
  for (int k = 0; k < 30'000; ++k) {
    const std::string bad = k % 2 == 0 ? "\x01\xff\xfe rubbish" : "91 0";
    text += (is_bad(k) ? bad : std::to_string(k % 90) + ' ' + std::to_string(k % 180)) + '\n';
  }
  return text;
}

TEST(Lookup, KeepsOrderAndLineNumbersWhateverThreadAnswers) {
  const auto is_bad = [](int k) { return k % 997 == 5; };
  const Outcome run = run_program({"lookup", "--json"}, many_records(is_bad));
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 30'000u);
  for (int k = 0; k < 30'000; ++k) {
    const json answer = json::parse(lines[static_cast<std::size_t>(k)]);
    if (is_bad(k)) {
      ASSERT_EQ(answer["line"], k + 1);
    } else {
      ASSERT_EQ(answer["lat"], k % 90);
      ASSERT_EQ(answer["lon"], k % 180);
    }
  }
}

TEST(Lookup, StopsAtTheFirstBadOfManyWithStrict) {
  const Outcome run = run_program({"lookup", "--strict", "--level", "3"},
                                  many_records([](int k) { return k > 20'000 && k % 3 == 0; }));
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 20'002u);
  EXPECT_EQ(lines.back().substr(0, 6), "ERROR:");
  EXPECT_EQ(lines[20'000].substr(0, 6), "20 20 ");
}

TEST(Lookup, MakesATable) {
  const Outcome run = run_program({"lookup", "--csv", "1 2", "x\"y"});
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "lat,lon,level,id,name,diamond,i,j,ecef_x_m,ecef_y_m,ecef_z_m,utm,mgrs");
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','),
            std::count(lines[1].begin(), lines[1].end(), ','));
  EXPECT_EQ(lines[2].substr(0, 8), "\"ERROR: ");
  EXPECT_NE(lines[2].find("x\"\"y"), std::string::npos);
  EXPECT_EQ(run_program({"lookup", "--csv", "--json", "1 2"}).status, 2);
}

TEST(Lookup, AnswersBeforeTheNextQuestionComes) {
  cli::Conversation globe({"lookup", "--level", "2"});
  EXPECT_EQ(globe.ask("10 10"), "10 10 2 248 N320 0 3 0");
  EXPECT_EQ(globe.ask("x").substr(0, 6), "ERROR:");
  EXPECT_EQ(globe.ask("-10 10").substr(0, 6), "-10 10");
}

TEST(Lookup, TakesLevelAndHeightFromAPlanet) {
  const json answer = json::parse(run_program({"lookup", "procedural", "--json", "1 2"}).out);
  EXPECT_EQ(answer["level"], 9);
  EXPECT_EQ(answer["id"], json::parse(run_program({"lookup", "--level", "9", "--json", "1 2"}).out)["id"]);
  EXPECT_EQ(answer["height_m"],
            json::parse(run_program({"height", "procedural", "--json", "1 2"}).out)["height_m"]);
  EXPECT_TRUE(answer["utm"].is_string());
  EXPECT_EQ(json::parse(run_program({"lookup", "procedural", "--level", "4", "--json", "1 2"}).out)["level"],
            4);
  const auto lines = run_program({"lookup", "procedural:7", "--csv"}, "1 2\n").lines();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "lat,lon,level,id,name,diamond,i,j,height_m,ecef_x_m,ecef_y_m,ecef_z_m,utm,mgrs");
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','),
            std::count(lines[1].begin(), lines[1].end(), ','));
}

TEST(Lookup, PutsPlacesOnThePlanetsEllipsoidAndNamesNoGridsOffTheEarth) {
  const tests::TemporaryFolder folder;
  const std::string moon = cli::make_planet(folder.path(), {"--ellipsoid", "moon"});
  const json answer = json::parse(run_program({"lookup", moon, "--json", "0 0 100"}).out);
  EXPECT_EQ(answer["ecef_m"][0].get<double>(), 1737500.0);
  EXPECT_TRUE(answer["utm"].is_null());
  EXPECT_TRUE(answer["mgrs"].is_null());
}

TEST(Lookup, InterpolatesHeightsAsHeightDoes) {
  for (const char* interpolation : {"nearest", "linear", "cubic"}) {
    const json named = json::parse(run_program({"lookup", "procedural", "--json", "--level", "14",
                                                "--interpolation", interpolation, "12.3 45.6"})
                                       .out);
    const json height = json::parse(
        run_program({"height", "procedural", "--json", "--interpolation", interpolation, "12.3 45.6"}).out);
    EXPECT_EQ(named["level"], 14);
    EXPECT_EQ(named["height_m"], height["height_m"]) << interpolation;
  }
  const auto with = [](const std::vector<std::string>& options) {
    std::vector<std::string> words{"lookup", "procedural", "12.3 45.6"};
    words.insert(words.end(), options.begin(), options.end());
    return run_program(words).out;
  };
  EXPECT_EQ(with({}), with({"--interpolation", "linear"}));
  EXPECT_NE(with({}), with({"--interpolation=cubic"}));
}

TEST(Lookup, RefusesToInterpolateWithoutAPlanetAndByUnknownWays) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"lookup", "--interpolation", "cubic", "1 2"},
        {"lookup", "procedural", "--interpolation", "magic", "1 2"}}) {
    const Outcome run = run_program(words);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

TEST(Lookup, SaysWhenItsOutputCannotBeWritten) {
  const std::string command = std::string(GLOBE_PROGRAM) + " lookup '1 2' > /dev/full 2> /dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace
