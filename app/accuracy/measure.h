#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

#include "app/accuracy/study.h"

namespace app::accuracy {

/// Cost of a setting, in the study's unit.
struct CostFigure {
  double median = 0;         ///< of the passes' medians
  double q1 = 0, q3 = 0;     ///< quartiles of all runs
  double low = 0, high = 0;  ///< 95 % confidence interval of the median
  std::size_t runs = 0;
};

/// Costs of one setting, in the order they were measured: those of each pass together.
using PassCosts = std::vector<std::vector<double>>;

/// Figures of what several passes cost, at least one, each of at least one run.
///
/// Runs of one pass lie within a second and resemble each other more than those of other passes: the machine
/// drifts over minutes. They count as one draw, by their median, and the interval is that of the median of
/// such draws by order statistics (David & Nagaraja, Order Statistics, 2003, 7.1): of six passes from the
/// least to the largest, 97 %.
CostFigure cost_figure(const PassCosts& passes);

/// A study with its costs, setting by setting.
struct MeasuredStudy {
  Study study;
  std::vector<CostFigure> costs;
  std::vector<bool> on_front;  ///< no other setting errs less (by its largest error) and costs less
};

/// How often studies are run.
struct Rounds {
  std::size_t passes = 6;                                             ///< over all studies
  std::size_t most = 11;                                              ///< of a study in a pass
  std::chrono::milliseconds enough = std::chrono::milliseconds(400);  ///< of a study in a pass
};
Rounds rounds_of(const Scope& scope);

/// Goes over all studies in several passes, so that each study's runs are spread over the whole time and hold
/// what the machine drifts in it. In a pass a study runs all its settings once a round, one after the other,
/// so that what else the machine does falls on all alike; one round at the least.
///
/// @param progress  called with the share that is done before each study of each pass
std::vector<MeasuredStudy> measure(
    std::vector<Study> studies, const Rounds& rounds,
    const std::function<void(double)>& progress = [](double) {});

/// Which of several (error, cost) no other betters in both.
std::vector<bool> pareto_front(const std::vector<double>& errors, const std::vector<double>& costs);

}  // namespace app::accuracy
