#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace app {

/// The clock of a flight in real time: no frame begins before its turn, as before an audience, so that what
/// loads in the background has the time that it would have there. A frame that is late delays the later ones.
class FrameClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param interval  from the beginning of a frame to that of the next
  explicit FrameClock(std::chrono::duration<double> interval)
      : interval_(std::chrono::duration_cast<Clock::duration>(interval)), next_(Clock::now()) {}

  /// Sleeps until the next frame's turn.
  void await_turn() {
    std::this_thread::sleep_until(next_);
    next_ = std::max(Clock::now(), next_) + interval_;
  }

 private:
  Clock::duration interval_;
  Clock::time_point next_;
};

}  // namespace app
