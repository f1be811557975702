#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using cli::text_of;
using nlohmann::json;

TEST(AccuracyCommand, GivesTheSameErrorsTwiceAndTimesWithTheirQuartiles) {
  const tests::TemporaryFolder folder;
  std::vector<json> reports;
  for (const char* name : {"a", "b"}) {
    const Outcome run =
        run_program({"accuracy", "-o", (folder / name).string(), "--only", "geodesics", "--quiet"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("Karney"), std::string::npos);
    reports.push_back(json::parse(text_of(folder / name / "accuracy.json")));
    EXPECT_NE(text_of(folder / name / "accuracy.html").find("<svg"), std::string::npos);
  }
  ASSERT_EQ(reports[0]["studies"].size(), 3u);
  for (std::size_t s = 0; s < reports[0]["studies"].size(); ++s) {
    const json &a = reports[0]["studies"][s]["settings"], &b = reports[1]["studies"][s]["settings"];
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (const char* key : {"name", "error_max", "error_rms", "error_where"})
        EXPECT_EQ(a[k][key], b[k][key]);
      EXPECT_LE(a[k]["cost_q1"], a[k]["cost_median"]);
      EXPECT_LE(a[k]["cost_median"], a[k]["cost_q3"]);
      EXPECT_GE(a[k]["runs"], 6);
    }
  }
  ASSERT_EQ(reports[0]["pace"].size(), 1u) << "nothing of it is drawn";
  EXPECT_GT(reports[0]["pace"][0]["cost_median"], 0.0);
  const std::string csv = text_of(folder / "a/accuracy.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 1 + 3 + 3 + 2);
}

TEST(AccuracyCommand, ComparesTwoReports) {
  const tests::TemporaryFolder folder;
  ASSERT_EQ(run_program({"accuracy", "-o", (folder / "a").string(), "--only", "storage", "--quiet"}).status,
            0);
  const std::string report = (folder / "a/accuracy.json").string();
  const Outcome alike = run_program({"accuracy", "--compare", report, report});
  EXPECT_EQ(alike.status, 0) << alike.err;
  const std::vector<std::string> lines = alike.lines();
  ASSERT_EQ(lines.size(), 3u) << alike.out;
  EXPECT_EQ(lines[0], "errors: equal in 4 of 4 settings");
  EXPECT_EQ(lines[1], "costs: 95 % intervals overlap in 0 of 0 settings whose cost is measured");
  EXPECT_TRUE(lines[2].starts_with("pace: 100,000 numbers sorted on one core, ms: ")) << lines[2];

  json worse = json::parse(text_of(report));
  worse["studies"][0]["settings"][1]["error_max"] = 1e6;
  std::ofstream(folder / "worse.json") << worse;
  const Outcome differ = run_program({"accuracy", "--compare", report, (folder / "worse.json").string()});
  EXPECT_NE(differ.out.find("errors: equal in 3 of 4 settings"), std::string::npos) << differ.out;
  EXPECT_NE(differ.out.find("and 1e+06"), std::string::npos) << differ.out;

  std::ofstream(folder / "no_report.json") << "{\"studies\": 3}";
  cli::expect_refusals("accuracy", {{{"--compare", report}, 2},
                                    {{"--compare", report, (folder / "no_report.json").string()}, 1},
                                    {{"--compare", report, (folder / "a/accuracy.csv").string()}, 1},
                                    {{"--compare", report, (folder / "missing.json").string()}, 1}});
}

TEST(AccuracyCommand, RefusesInOneLine) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder / "accuracy.csv") << "mine";
  cli::expect_refusals("accuracy", {{{}, 2},
                                    {{"-o", folder.path().string(), "--only", "alchemy"}, 2},
                                    {{"-o", folder.path().string(), "--suite", "long"}, 2},
                                    {{"-o", folder.path().string(), "--only", "storage"}, 1}});
  EXPECT_EQ(text_of(folder / "accuracy.csv"), "mine");
  const Outcome beneath_a_file =
      run_program({"accuracy", "-o", (folder / "accuracy.csv" / "report").string(), "--only", "storage"});
  EXPECT_EQ(beneath_a_file.status, 1);
  EXPECT_NE(beneath_a_file.err.find("choose a folder that may be written"), std::string::npos)
      << beneath_a_file.err;
}

}  // namespace
