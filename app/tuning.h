#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/accuracy/drawing_quality.h"

namespace app {

/// What a person wants of a picture: one of the two.
struct TuningGoal {
  std::optional<double> fps;       ///< frames a second, in every view that is judged
  std::optional<double> error_px;  ///< largest error of the drawn ground, pixels
};

/// Settings on the measured front, by rising detail, and the one that reaches the goal.
struct Tuning {
  std::vector<bool> on_front;         ///< of the qualities that were measured, by error and time
  std::optional<std::size_t> chosen;  ///< none reaches the goal
  std::size_t nearest = 0;            ///< that which comes nearest to it
};

/// For fps: the smallest error whose median frame, and the upper end of its 95 % interval, fits. For an
/// error: the fastest that does not exceed it. REQUIRES: qualities is not empty, one goal is set.
Tuning tune(const std::vector<accuracy::DrawingQuality>& qualities, const TuningGoal& goal);

}  // namespace app
