#pragma once

#include <deque>
#include <optional>

namespace app {

/// What the frames of a flight may spend on uploads: what drawing usually leaves of the time for a frame.
class FrameBudget {
 public:
  /// @param frame_ms  for a whole frame, milliseconds; none: a third more than drawing usually takes, so that
  ///                  a frame with uploads is hardly told from one without
  explicit FrameBudget(std::optional<double> frame_ms) : frame_ms_(frame_ms) {}

  /// For the next frame, milliseconds: a little even where drawing alone takes too long, or nothing would
  /// ever be complete.
  double uploads_ms() const;

  /// A frame was drawn, and spent so much of its time on uploads.
  void note(double frame_ms, double upload_ms);

 private:
  std::optional<double> frame_ms_;
  std::deque<double> drawing_ms_;  ///< of the last frames
};

}  // namespace app
