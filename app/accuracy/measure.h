#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "app/accuracy/study.h"

namespace app::accuracy {

/// Cost of a setting over interleaved runs, in the study's unit.
struct CostFigure {
  double median = 0;
  double q1 = 0, q3 = 0;     ///< quartiles
  double low = 0, high = 0;  ///< 95 % confidence interval of the median
  std::size_t runs = 0;
};

/// Median, quartiles and interval of what several runs cost; at least one.
CostFigure cost_figure(const std::vector<double>& costs);

/// A study with its costs, setting by setting.
struct MeasuredStudy {
  Study study;
  std::vector<CostFigure> costs;
  std::vector<bool> on_front;  ///< no other setting errs less (by its largest error) and costs less
};

/// Runs all settings of a study once a round, one after the other, so that what else the machine does falls
/// on all alike. Rounds: 31, in full 101, but no more than fit a few seconds (in full a minute), and 7 (31)
/// at the least.
MeasuredStudy measure(Study study, const Scope& scope);

/// Which of several (error, cost) no other betters in both.
std::vector<bool> pareto_front(const std::vector<double>& errors, const std::vector<double>& costs);

}  // namespace app::accuracy
