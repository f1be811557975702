#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "app/accuracy/measure.h"
#include "app/accuracy/pace.h"
#include "app/accuracy/report.h"

namespace app::accuracy {
namespace {

TEST(ParetoFront, HoldsWhatNothingBettersInBothErrorAndCost) {
  //                     a    b    c    d    e: as good as b in error, dearer
  EXPECT_EQ(pareto_front({9.0, 3.0, 1.0, 2.0, 3.0}, {1.0, 2.0, 4.0, 5.0, 3.0}),
            (std::vector<bool>{true, true, true, false, false}));
  EXPECT_EQ(pareto_front({1.0, 1.0}, {2.0, 2.0}), (std::vector<bool>{true, true}));
}

TEST(ErrorSum, KeepsTheLargestItsPlaceAndTheRootMeanSquare) {
  ErrorSum sum;
  for (const double error : {3.0, -4.0, 0.0, 0.0}) sum.add(error, [&] { return std::to_string(error); });
  EXPECT_EQ(sum.figure().max, 4.0);
  EXPECT_EQ(sum.figure().rms, 2.5);
  EXPECT_EQ(sum.figure().where, std::to_string(-4.0));
}

TEST(ErrorSum, ANotANumberIsNotLost) {
  ErrorSum sum;
  sum.add(1.0, [] { return "a"; });
  sum.add(std::nan(""), [] { return "b"; });
  EXPECT_TRUE(std::isnan(sum.figure().rms));
}

TEST(AccuracyReport, QuotesWhatWouldBreakACsvOrAPage) {
  Study study{"name", "a < b & c", "", "ref", "sample", "m", "ns", {}};
  study.settings.push_back({"with, \"quotes\"", {1.0, 0.5, "x"}, fixed(2.0), true});
  study.settings.push_back({"other", {2.0, 0.5, "x"}, fixed(1.0)});
  const Report report{provenance("globe accuracy", "quick"), measure({pace_of_machine({})}, {}).front(),
                      measure({study}, {})};
  EXPECT_NE(csv_of(report).find("\"with, \"\"quotes\"\"\",true"), std::string::npos);
  const std::string page = html_of(report);
  EXPECT_NE(page.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos) << "the page needs no other file";
}

TEST(AccuracyStudies, EveryOneHasNamesUnitsASampleAndAtMostOneDefault) {
  std::set<std::string> names;
  for (const Family& family : families()) {
    if (family.draws || family.name == "conversion" || family.name == "heights")
      continue;  // seconds; the program's test has them
    for (const Study& study : family.studies({})) {
      EXPECT_TRUE(names.insert(study.name).second) << study.name;
      EXPECT_EQ(study.name.find(family.name), 0u) << study.name;
      for (const std::string& text :
           {study.title, study.reference, study.sample, study.error_unit, study.cost_unit})
        EXPECT_FALSE(text.empty()) << study.name;
      int defaults = 0;
      EXPECT_GE(study.settings.size(), 2u) << study.name;
      for (const Setting& setting : study.settings) {
        defaults += setting.is_default ? 1 : 0;
        EXPECT_TRUE(std::isfinite(setting.error.max) && std::isfinite(setting.error.rms)) << setting.name;
        EXPECT_LE(setting.error.rms, setting.error.max * (1.0 + 1e-12)) << setting.name;
        EXPECT_TRUE(setting.error.max == 0.0 || !setting.error.where.empty()) << setting.name;
      }
      EXPECT_LE(defaults, 1) << study.name;
    }
  }
}

}  // namespace
}  // namespace app::accuracy
