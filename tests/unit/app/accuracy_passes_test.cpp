#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "app/accuracy/compare.h"
#include "app/accuracy/measure.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/report.h"

// Costs are spread over the whole run, and their intervals hold what the machine drifts in it.

namespace app::accuracy {
namespace {

using std::chrono::hours;

Study study_of(const std::string& name, std::vector<std::function<double()>> costs) {
  Study study{name, "title", "", "reference", "sample", "m", "ms", {}};
  const ErrorFigure error{1.0, 0.5, "here"};
  for (std::size_t k = 0; k < costs.size(); ++k)
    study.settings.push_back({std::to_string(k), error, costs[k]});
  return study;
}

TEST(MeasuredCosts, EveryPassGoesOverAllStudiesAndARoundOverAllSettings) {
  std::string order;
  const auto noted = [&](char letter) {
    return [&order, letter] {
      order += letter;
      return 1.0;
    };
  };
  const auto measured =
      measure({study_of("first", {noted('a'), noted('b')}), study_of("second", {noted('c')})},
              {.passes = 3, .most = 2, .enough = hours(1)});
  EXPECT_EQ(order, "ababccababccababcc");
  EXPECT_EQ(measured[0].costs[1].runs, 6u);
  EXPECT_EQ(measured[1].study.name, "second");
}

TEST(MeasuredCosts, APassHasOneRoundOfAStudyThatTakesLonger) {
  const auto measured = measure({study_of("slow", {[] { return 1.0; }})},
                                {.passes = 4, .most = 100, .enough = std::chrono::milliseconds(-1)});
  EXPECT_EQ(measured[0].costs[0].runs, 4u);
}

TEST(MeasuredCosts, WhatAStudyMakesIsMadeUnmeasuredAndReleasedBeforeTheNextStudy) {
  std::string order;
  double runs = 0;
  Study large = study_of("large", {[&] {
                           order += 'a';
                           return ++runs;
                         }});
  large.settings[0].release = [&] {
    order += '/';
    runs = 0;
  };
  const auto measured = measure({large, study_of("small", {[&] {
                                                   order += 'b';
                                                   return 1.0;
                                                 }})},
                                {.passes = 2, .most = 2, .enough = hours(1)});
  EXPECT_EQ(order, "aaa/bbaaa/bb");
  EXPECT_EQ(measured[0].costs[0].runs, 4u);
  EXPECT_EQ(measured[0].costs[0].low, 2.0) << "the first run is not counted";
  EXPECT_FALSE(measured[0].study.settings[0].cost || measured[0].study.settings[0].release);
}

TEST(MeasuredCosts, ThePaceIsTakenBeforeEveryStudyOfEveryPass) {
  std::string order;
  const auto noted = [&](char letter) {
    return [&order, letter] {
      order += letter;
      return static_cast<double>(order.size());
    };
  };
  const MeasuredBeside measured = measure_beside(study_of("pace", {noted('p')}),
                                                 {study_of("a", {noted('a')}), study_of("b", {noted('b')})},
                                                 {.passes = 2, .most = 2, .enough = hours(1)});
  EXPECT_EQ(order, "paapbbpaapbb");
  EXPECT_EQ(measured.pace.costs[0].runs, 4u);
  EXPECT_EQ(measured.pace.costs[0].passes, (std::vector<double>{1.0, 7.0}));
  EXPECT_EQ(measured.studies[1].costs[0].passes, (std::vector<double>{5.0, 11.0}));
}

TEST(Remade, IsMadeWhenItIsAskedForAndAgainAfterItsRelease) {
  struct Large {
    Large(std::vector<int>* alive, int value) : alive_(alive) { alive_->push_back(value); }
    ~Large() { alive_->pop_back(); }
    std::vector<int>* alive_;
  };
  std::vector<int> alive;
  std::vector<int>* const to = &alive;
  const auto large = remade<Large>(to, 7);
  EXPECT_TRUE(alive.empty());
  const Large* first = &large->get();
  EXPECT_EQ(&large->get(), first);
  EXPECT_EQ(alive, std::vector<int>{7});
  const auto release = release_of(large);
  release();
  EXPECT_TRUE(alive.empty());
  large->get();
  EXPECT_EQ(alive, std::vector<int>{7});
}

TEST(MeasuredCosts, TheIntervalIsThatOfThePassesMedians) {
  const CostFigure cost = cost_figure({{9.0, 1.0, 1.0},
                                       {2.0, 2.0, 2.0},
                                       {3.0, 3.0, 0.0},
                                       {4.0, 4.0, 4.0},
                                       {5.0, 5.0, 5.0},
                                       {6.0, 6.0, 90.0}});
  EXPECT_EQ(cost.low, 1.0);
  EXPECT_EQ(cost.high, 6.0);
  EXPECT_EQ(cost.median, 3.0);
  EXPECT_EQ(cost.runs, 18u);
  EXPECT_EQ(cost.passes, (std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
}

/// A machine whose speed wanders by 5 % and forgets where it was in half a minute, with a clock of its own.
class DriftingMachine {
 public:
  explicit DriftingMachine(unsigned seed) : random_(seed), speed_(0.05 * normal_(random_)) {}

  /// What work of a second costs now, by the clock; single runs scatter by 1 %.
  double run() {
    constexpr double kStep_s = 0.1, kMemory_s = 30.0;
    const double kept = std::exp(-kStep_s / kMemory_s);
    speed_ = kept * speed_ + 0.05 * std::sqrt(1.0 - kept * kept) * normal_(random_);
    return times_ * (1.0 + speed_ + 0.01 * normal_(random_));
  }
  void rest() {
    for (int k = 0; k < 600; ++k) run();
  }
  /// From now on everything takes so many times as long.
  void slow_down(double times) { times_ = times; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double speed_;
  double times_ = 1.0;
};

/// Forty studies on a machine, each as a report has it.
nlohmann::json report_of(DriftingMachine& machine, bool in_passes) {
  std::vector<Study> studies;
  for (int k = 0; k < 40; ++k)
    studies.push_back(study_of("study " + std::to_string(k), {[&] { return machine.run(); }}));
  Report report{{}, {}, {}};
  if (in_passes) {
    MeasuredBeside measured = measure_beside(study_of("pace", {[&] { return machine.run(); }}), studies,
                                             {.passes = 8, .most = 5, .enough = hours(1)});
    report.pace = std::move(measured.pace);
    report.studies = std::move(measured.studies);
  } else {  // each study by itself, every run a draw of its own
    for (const Study& study : studies)
      report.studies.push_back(measure({study}, {.passes = 30, .most = 1, .enough = hours(1)}).front());
  }
  machine.rest();
  return nlohmann::json::parse(json_of(report));
}

/// In how many of all settings intervals overlap, as they are and by the pace.
struct Shares {
  double overlapping = 0, by_pace = 0;
};

Shares shares(bool in_passes, double second_slower) {
  double overlapping = 0, by_pace = 0, settings = 0;
  for (unsigned seed = 1; seed <= 25; ++seed) {
    DriftingMachine machine(seed);
    const nlohmann::json first = report_of(machine, in_passes);
    machine.slow_down(second_slower);
    const Comparison comparison = compare(first, report_of(machine, in_passes));
    overlapping += static_cast<double>(comparison.overlapping);
    by_pace += static_cast<double>(comparison.overlapping_by_pace);
    settings += static_cast<double>(comparison.varying);
  }
  return {overlapping / settings, by_pace / settings};
}

TEST(MeasuredCosts, IntervalsOfTwoRunsOverlapThoughTheMachineDrifts) {
  EXPECT_GT(shares(true, 1.0).overlapping, 0.98);
  EXPECT_LT(shares(false, 1.0).overlapping, 0.5) << "the drift is too small to tell";
}

TEST(MeasuredCosts, ByThePaceIntervalsOverlapThoughTheMachineIsSlowerInOneRun) {
  const Shares seen = shares(true, 1.5);
  EXPECT_GT(seen.by_pace, 0.98);
  EXPECT_LT(seen.overlapping, 0.5) << "the machine is not slow enough to tell";
}

/// A report of one study, "s", with settings {name, error, low, high}, and a pace.
nlohmann::json made_up(const std::vector<std::tuple<std::string, double, double, double>>& settings,
                       double pace_ms) {
  nlohmann::json rows = nlohmann::json::array();
  for (const auto& [name, error, low, high] : settings)
    rows.push_back({{"name", name},
                    {"error_max", error},
                    {"error_rms", 0.5 * error},
                    {"error_where", "there"},
                    {"cost_median", low},
                    {"cost_low", low},
                    {"cost_high", high}});
  return {{"pace",
           {{{"name", "work"},
             {"cost_median", pace_ms},
             {"cost_low", 0.9 * pace_ms},
             {"cost_high", 1.1 * pace_ms}}}},
          {"studies", {{{"name", "s"}, {"cost_unit", "ms"}, {"settings", rows}}}}};
}

TEST(ComparedReports, CountEqualErrorsAndIntervalsThatMeetAndNameTheOthers) {
  const Comparison comparison = compare(made_up({{"same", 1.0, 2.0, 3.0},
                                                 {"slower", 1.0, 2.0, 3.0},
                                                 {"worse", 1.0, 2.0, 3.0},
                                                 {"bytes", 1.0, 8.0, 8.0},
                                                 {"gone", 1.0, 1.0, 1.0}},
                                                5.0),
                                        made_up({{"same", 1.0, 3.0, 4.0},
                                                 {"slower", 1.0, 3.5, 4.0},
                                                 {"worse", 1.5, 2.5, 2.6},
                                                 {"bytes", 1.0, 8.0, 8.0},
                                                 {"new", 1.0, 1.0, 1.0}},
                                                5.5));
  EXPECT_EQ(comparison.settings, 4u);
  EXPECT_EQ(comparison.equal_errors, 3u);
  EXPECT_EQ(comparison.varying, 3u) << "bytes are counted, not measured";
  EXPECT_EQ(comparison.overlapping, 2u);
  EXPECT_EQ(
      comparison.differences,
      (std::vector<std::string>{"s, gone: in the first report only", "s, slower, ms: 2 to 3 and 3.5 to 4",
                                "s, worse: errors up to 1 and 1.5", "s, new: in the second report only"}));
  EXPECT_EQ(comparison.paces, std::vector<std::string>{"work, ms: 4.5 to 5.5 and 4.95 to 6.05"});
  const std::string text = text_of(comparison);
  EXPECT_NE(text.find("errors: equal in 3 of 4 settings"), std::string::npos) << text;
  EXPECT_NE(text.find("overlap in 2 of 3 settings"), std::string::npos) << text;
}

TEST(ComparedReports, TellWhenTheMachineItselfWasSlower) {
  const auto paces = compare(made_up({}, 5.0), made_up({}, 10.0)).paces;
  ASSERT_EQ(paces.size(), 1u);
  EXPECT_NE(paces[0].find("the machine itself took 2 times as long in the second"), std::string::npos)
      << paces[0];
}

TEST(ComparedReports, TellByThePaceOfEachPassWhatIsAlikeOnAMachineThatBecameSlower) {
  // In the second report everything takes twice as long, and a third as long again in its last pass.
  const auto report = [](double slower, double dearer) {
    nlohmann::json made = made_up({{"steady", 1.0, 2.0 * slower, 2.2 * slower},
                                   {"dearer", 1.0, 2.0 * slower * dearer, 2.2 * slower * dearer}},
                                  5.0 * slower);
    const double last = slower > 1.0 ? 1.3 : 1.0;
    made["pace"][0]["cost_passes"] = {5.0 * slower, 5.0 * slower * last};
    auto& settings = made["studies"][0]["settings"];
    settings[0]["cost_passes"] = {2.0 * slower, 2.2 * slower * last};
    settings[1]["cost_passes"] = {2.0 * slower * dearer, 2.2 * slower * dearer * last};
    return made;
  };
  const Comparison comparison = compare(report(1.0, 1.0), report(2.0, 1.5));
  EXPECT_EQ(comparison.varying, 2u);
  EXPECT_EQ(comparison.overlapping, 0u);
  EXPECT_EQ(comparison.paced, 2u);
  EXPECT_EQ(comparison.overlapping_by_pace, 1u);
  ASSERT_EQ(comparison.differences.size(), 2u);
  EXPECT_EQ(comparison.differences[0], "s, dearer, ms: 2 to 2.2 and 6 to 6.6");
  EXPECT_EQ(comparison.differences[1], "s, steady, ms: 2 to 2.2 and 4 to 4.4, alike by the machine's pace");
  EXPECT_NE(text_of(comparison).find("by the machine's pace, pass by pass: they overlap in 1 of 2 settings"),
            std::string::npos)
      << text_of(comparison);
}

TEST(ComparedReports, AReportWithoutAPaceIsComparedAllTheSame) {
  nlohmann::json old = made_up({{"same", 1.0, 2.0, 3.0}}, 5.0);
  old.erase("pace");
  const Comparison comparison = compare(old, made_up({{"same", 1.0, 2.0, 3.0}}, 5.0));
  EXPECT_EQ(comparison.overlapping, 1u);
  EXPECT_TRUE(comparison.paces.empty());
  EXPECT_EQ(comparison.paced, 0u);
}

}  // namespace
}  // namespace app::accuracy
