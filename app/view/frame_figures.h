#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "globe/render/surface_renderer.h"

namespace app::view {

/// Figures of the frames that a window drew last.
class FrameFigures {
 public:
  static constexpr std::size_t kKept = 240;

  void add(double frame_ms, const globe::render::FrameStats& frame);

  const globe::render::FrameStats& last() const { return last_; }
  std::size_t frames() const { return frames_; }
  /// Milliseconds of the frames kept, the oldest first.
  std::vector<float> times_ms() const;
  /// By nearest rank; 0 of none.
  double percentile_ms(double p) const;

 private:
  std::array<float, kKept> times_{};
  std::size_t frames_ = 0;
  globe::render::FrameStats last_;
};

}  // namespace app::view
