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
  std::vector<double> passes;  ///< the median of each, in the order they were measured
};

/// Costs of one setting, in the order they were measured: those of each pass together.
using PassCosts = std::vector<std::vector<double>>;

/// Figures of what several passes cost, at least one, each of at least one run.
///
/// Runs of one pass lie within a second and resemble each other more than those of other passes: the machine
/// drifts over minutes. They count as one draw, by their median, and the interval is that of the median of
/// such draws by order statistics (David & Nagaraja, Order Statistics, 2003, 7.1): of eight passes from the
/// least to the largest, which holds it in 99 % of all cases where the next narrower one does in 93 %.
CostFigure cost_figure(const PassCosts& passes);

/// A study with its costs, setting by setting.
struct MeasuredStudy {
  Study study;
  std::vector<CostFigure> costs;
  std::vector<bool> on_front;  ///< no other setting errs less (by its largest error) and costs less
};

/// How often studies are run.
struct Rounds {
  std::size_t passes = 8;                                             ///< over all studies
  std::size_t most = 8;                                               ///< of a study in a pass
  std::chrono::milliseconds enough = std::chrono::milliseconds(300);  ///< of a study in a pass
};
Rounds rounds_of(const Scope& scope);

/// Goes over all studies in several passes, so that each study's runs are spread over the whole time and hold
/// what the machine drifts in it. In a pass a study runs all its settings once a round, one after the other,
/// so that what else the machine does falls on all alike; one round at the least. Settings that make large
/// things for it run once before, unmeasured, and release them afterwards: one study at a time has such
/// things. What is made anew in each pass lies elsewhere in memory each time, which is a part of what a cost
/// varies by from run to run of the program, too.
///
/// @param progress  called with the share that is done before each study of each pass
std::vector<MeasuredStudy> measure(
    std::vector<Study> studies, const Rounds& rounds,
    const std::function<void(double)>& progress = [](double) {});

/// Studies and fixed work that was measured beside them.
struct MeasuredBeside {
  MeasuredStudy pace;
  std::vector<MeasuredStudy> studies;
};

/// The same with fixed work beside: each of its settings runs once before each study of each pass, so that
/// its cost in a pass follows what the machine drifts in it.
MeasuredBeside measure_beside(
    Study pace, std::vector<Study> studies, const Rounds& rounds,
    const std::function<void(double)>& progress = [](double) {});

/// Which of several (error, cost) no other betters in both.
std::vector<bool> pareto_front(const std::vector<double>& errors, const std::vector<double>& costs);

}  // namespace app::accuracy
