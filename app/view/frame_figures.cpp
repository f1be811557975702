#include "app/view/frame_figures.h"

#include <algorithm>

#include "app/flight_stats.h"

namespace app::view {

void FrameFigures::add(double frame_ms, const globe::render::FrameStats& frame) {
  times_[frames_++ % kKept] = static_cast<float>(frame_ms);
  last_ = frame;
}

std::vector<float> FrameFigures::times_ms() const {
  std::vector<float> times;
  const std::size_t kept = std::min(frames_, kKept);
  for (std::size_t k = frames_ - kept; k < frames_; ++k) times.push_back(times_[k % kKept]);
  return times;
}

double FrameFigures::percentile_ms(double p) const {
  const std::vector<float> times = times_ms();
  return percentile({times.begin(), times.end()}, p);
}

}  // namespace app::view
