#include "app/frame_budget.h"

#include <algorithm>
#include <vector>

#include "app/flight_stats.h"

namespace app {
namespace {

constexpr std::size_t kFrames = 15;         ///< whose median is the usual time
constexpr double kUploadShare = 1.0 / 3.0;  ///< of drawing, for uploads
constexpr double kLeastShare = 1.0 / 16.0;  ///< of drawing, in any case
constexpr double kFirst = 4.0;              ///< milliseconds, before any frame was drawn

}  // namespace

double FrameBudget::uploads_ms() const {
  if (drawing_ms_.empty()) return std::min(kFirst, frame_ms_.value_or(kFirst));
  const double usual = percentile({drawing_ms_.begin(), drawing_ms_.end()}, 50);
  return frame_ms_ ? std::max(*frame_ms_ - usual, kLeastShare * usual) : kUploadShare * usual;
}

void FrameBudget::note(double frame_ms, double upload_ms) {
  drawing_ms_.push_back(frame_ms - upload_ms);
  if (drawing_ms_.size() > kFrames) drawing_ms_.pop_front();
}

}  // namespace app
