#include "app/tuning.h"

#include <algorithm>

namespace app {

using accuracy::DrawingQuality;

Tuning tune(const std::vector<DrawingQuality>& qualities, const TuningGoal& goal) {
  std::vector<double> errors, costs;
  for (const DrawingQuality& quality : qualities) {
    errors.push_back(quality.error_px.max);
    costs.push_back(quality.frame.ms.median);
  }
  Tuning tuning{accuracy::pareto_front(errors, costs), std::nullopt};
  const auto reaches = [&](std::size_t k) {
    return goal.fps ? qualities[k].frame.ms.high <= 1000.0 / *goal.fps : errors[k] <= *goal.error_px;
  };
  // For the one the other counts.
  const std::vector<double>& wanted = goal.fps ? errors : costs;
  const std::vector<double>& missed = goal.fps ? costs : errors;
  for (std::size_t k = 0; k < qualities.size(); ++k) {
    if (missed[k] < missed[tuning.nearest]) tuning.nearest = k;
    if (tuning.on_front[k] && reaches(k) && (!tuning.chosen || wanted[k] < wanted[*tuning.chosen]))
      tuning.chosen = k;
  }
  return tuning;
}

}  // namespace app
