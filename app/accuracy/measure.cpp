#include "app/accuracy/measure.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/accuracy/freed_memory.h"
#include "app/bench.h"
#include "app/flight_stats.h"

namespace app::accuracy {
namespace {

constexpr Rounds kQuick;
constexpr Rounds kFull{12, 8, std::chrono::seconds(5)};

void run_round(const Study& study, std::size_t pass, std::vector<PassCosts>& costs) {
  for (std::size_t k = 0; k < study.settings.size(); ++k) costs[k][pass].push_back(study.settings[k].cost());
}

/// One round after another of all settings, as many as a pass has.
void run_pass(const Study& study, const Rounds& rounds, std::size_t pass, std::vector<PassCosts>& costs) {
  for (const Setting& setting : study.settings)
    if (setting.release) setting.cost();  // makes what it needs
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t round = 0; round < rounds.most; ++round) {
    if (round > 0 && std::chrono::steady_clock::now() - begin > rounds.enough) break;
    run_round(study, pass, costs);
  }
  bool released = false;
  for (const Setting& setting : study.settings) {
    if (!setting.release) continue;
    setting.release();
    released = true;
  }
  if (released) return_freed_memory();
}

MeasuredStudy measured_of(Study study, const std::vector<PassCosts>& costs) {
  MeasuredStudy measured{std::move(study), {}, {}};
  std::vector<double> errors, medians;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    measured.costs.push_back(cost_figure(costs[k]));
    measured.study.settings[k].cost = nullptr;  // and what it holds: windows, contexts
    measured.study.settings[k].release = nullptr;
    errors.push_back(measured.study.settings[k].error.max);
    medians.push_back(measured.costs.back().median);
  }
  measured.on_front = pareto_front(errors, medians);
  return measured;
}

}  // namespace

Rounds rounds_of(const Scope& scope) { return scope.full ? kFull : kQuick; }

CostFigure cost_figure(const PassCosts& passes) {
  std::vector<double> all, medians;
  for (const std::vector<double>& pass : passes) {
    all.insert(all.end(), pass.begin(), pass.end());
    medians.push_back(percentile(pass, 50));
  }
  const Interval interval = median_interval(medians);
  return {percentile(medians, 50), percentile(all, 25), percentile(all, 75), interval.low,
          interval.high,           all.size(),          std::move(medians)};
}

std::vector<bool> pareto_front(const std::vector<double>& errors, const std::vector<double>& costs) {
  std::vector<bool> front(errors.size());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    bool bettered = false;
    for (std::size_t m = 0; m < errors.size(); ++m) {
      const bool no_worse = errors[m] <= errors[k] && costs[m] <= costs[k];
      bettered = bettered || (no_worse && (errors[m] < errors[k] || costs[m] < costs[k]));
    }
    front[k] = !bettered;
  }
  return front;
}

std::vector<MeasuredStudy> measure(std::vector<Study> studies, const Rounds& rounds,
                                   const std::function<void(double)>& progress) {
  return measure_beside({}, std::move(studies), rounds, progress).studies;
}

MeasuredBeside measure_beside(Study pace, std::vector<Study> studies, const Rounds& rounds,
                              const std::function<void(double)>& progress) {
  const auto none_of = [&](const Study& study) {
    return std::vector<PassCosts>(study.settings.size(), PassCosts(rounds.passes));
  };
  std::vector<PassCosts> pace_costs = none_of(pace);
  std::vector<std::vector<PassCosts>> costs;  // study, setting
  for (const Study& study : studies) costs.push_back(none_of(study));
  const auto turns = static_cast<double>(rounds.passes * studies.size());
  for (std::size_t pass = 0; pass < rounds.passes; ++pass) {
    for (std::size_t s = 0; s < studies.size(); ++s) {
      progress(static_cast<double>(pass * studies.size() + s) / turns);
      run_round(pace, pass, pace_costs);
      run_pass(studies[s], rounds, pass, costs[s]);
    }
  }
  MeasuredBeside measured{measured_of(std::move(pace), pace_costs), {}};
  for (std::size_t s = 0; s < studies.size(); ++s)
    measured.studies.push_back(measured_of(std::move(studies[s]), costs[s]));
  return measured;
}

}  // namespace app::accuracy
