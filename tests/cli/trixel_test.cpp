#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/run_program.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

json trixel(const std::string& id) { return json::parse(run_program({"trixel", "--json", id}).out); }

TEST(TrixelCommand, AnswersAllKeysOfTheContract) {
  const Outcome run = run_program({"trixel", "--json", "N012"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  const json answer = json::parse(run.out);
  EXPECT_EQ(answer["id"], 198);
  EXPECT_EQ(answer["name"], "N012");
  EXPECT_EQ(answer["level"], 2);
  EXPECT_EQ(answer["parent"], 49);
  EXPECT_EQ(answer["children"], (json{792, 793, 794, 795}));
  EXPECT_EQ(answer["neighbors"], (json{199, 206, 245}));
  EXPECT_EQ(answer["corners"][0], (json{45.0, 0.0}));
  EXPECT_EQ(answer["center"].size(), 2u);
  EXPECT_NEAR(answer["area_km2"].get<double>(), 3442246.32, 0.01);
}

TEST(TrixelCommand, TakesIdsAndNamesAlike) {
  for (const char* same : {"198", "N012", "n012", " N012 ", "0198"})
    EXPECT_EQ(run_program({"trixel", same}).out, run_program({"trixel", "N012"}).out) << same;
}

TEST(TrixelCommand, RootsHaveNoParentAndTheDeepestNoChildren) {
  EXPECT_TRUE(trixel("S0")["parent"].is_null());
  EXPECT_EQ(trixel("8")["children"].size(), 4u);
  const std::string deepest = "N3" + std::string(28, '0');
  EXPECT_EQ(trixel(deepest)["level"], 28);
  EXPECT_TRUE(trixel(deepest)["children"].empty());
  EXPECT_EQ(trixel(deepest)["neighbors"].size(), 3u);
}

TEST(TrixelCommand, TheEightRootsCoverTheEllipsoid) {
  double sum_km2 = 0;
  for (int id = 8; id < 16; ++id) sum_km2 += trixel(std::to_string(id))["area_km2"].get<double>();
  EXPECT_NEAR(sum_km2, 510065621.724088, 1e-5);  // WGS84: 2 pi a² (1 + (1 - e²) atanh(e) / e)
}

TEST(TrixelCommand, CenterLooksUpToTheSameTrixel) {
  for (const char* name : {"N0", "S31", "N012031", "S20133012310", "N123012301230123012301230123"}) {
    const json answer = trixel(name);
    const std::string point = answer["center"][0].dump() + "," + answer["center"][1].dump();
    const Outcome run =
        run_program({"lookup", "--json", "--level", std::to_string(answer["level"].get<int>()), point});
    EXPECT_EQ(json::parse(run.out)["name"], name);
  }
}

TEST(TrixelCommand, RefusesWhatIsNoTrixel) {
  for (const char* bad :
       {"0", "7", "16", "31", "N", "N4", "X0", "N0 1", "-8", "8.0", "1e3", "18446744073709551616",
        "N012301230123012301230123012301", "", "4611686018427387904"}) {
    const Outcome run = run_program({"trixel", bad, "8"});
    const auto lines = run.lines();
    ASSERT_EQ(lines.size(), 2u) << bad << ": " << run.out << run.err;
    EXPECT_EQ(lines[0].substr(0, 7), "ERROR: ") << bad;
    EXPECT_EQ(lines[1].substr(0, 5), "8 S0 ") << bad;
    EXPECT_EQ(run.status, 1) << bad;
  }
}

TEST(TrixelCommand, ReadsRecordsFromStandardInput) {
  const Outcome run = run_program({"trixel"}, "8\n# nine\nS1\n\nx\n");
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0].substr(0, 7), "8 S0 0 ");
  EXPECT_EQ(lines[1], "# nine");
  EXPECT_EQ(lines[2].substr(0, 7), "9 S1 0 ");
  EXPECT_EQ(lines[4].substr(0, 7), "ERROR: ");
  EXPECT_EQ(run.status, 1);
}

TEST(TrixelCommand, MakesATable) {
  const auto lines = run_program({"trixel", "--csv", "8", "N0123"}).lines();
  ASSERT_EQ(lines.size(), 3u);
  for (const std::string& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 14) << line;
}

}  // namespace
