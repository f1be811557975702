#include "app/accuracy/measure.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/bench.h"
#include "app/flight_stats.h"

namespace app::accuracy {
namespace {

struct Rounds {
  std::size_t least, most;
  std::chrono::seconds enough;
};
constexpr Rounds kQuick{7, 31, std::chrono::seconds(4)};
constexpr Rounds kFull{31, 101, std::chrono::seconds(60)};

}  // namespace

CostFigure cost_figure(const std::vector<double>& costs) {
  const Interval interval = median_interval(costs);
  return {percentile(costs, 50), percentile(costs, 25), percentile(costs, 75),
          interval.low,          interval.high,         costs.size()};
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

MeasuredStudy measure(Study study, const Scope& scope) {
  const Rounds& rounds = scope.full ? kFull : kQuick;
  std::vector<std::vector<double>> costs(study.settings.size());
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t round = 0; round < rounds.most; ++round) {
    if (round >= rounds.least && std::chrono::steady_clock::now() - begin > rounds.enough) break;
    for (std::size_t k = 0; k < costs.size(); ++k) costs[k].push_back(study.settings[k].cost());
  }
  MeasuredStudy measured{std::move(study), {}, {}};
  std::vector<double> errors, medians;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    measured.costs.push_back(cost_figure(costs[k]));
    measured.study.settings[k].cost = nullptr;  // and what it holds: windows, contexts
    errors.push_back(measured.study.settings[k].error.max);
    medians.push_back(measured.costs.back().median);
  }
  measured.on_front = pareto_front(errors, medians);
  return measured;
}

}  // namespace app::accuracy
