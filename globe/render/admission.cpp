#include "globe/render/admission.h"

#include <algorithm>

namespace globe::render {
namespace {

constexpr float kLateFade = 0.1f;  ///< what a late level morphs in by in a frame, if it is the only one

}  // namespace

clipmap::FinestLevel Admission::next(const clipmap::FinestLevel& wanted, int available) {
  const int limit = std::min(wanted.level, available);
  const auto by_height = [&](int level) { return level == wanted.level ? wanted.fade : 0.0f; };
  const float step = kLateFade * static_cast<float>(1 + std::max(limit - shown_.level, 0));
  if (shown_.level < 0 || limit < shown_.level) {
    shown_ = {limit, by_height(limit)};
    late_ = false;
  } else if (limit > shown_.level && shown_.fade == 0.0f) {
    late_ = shown_.level != wanted_before_ || wanted.level != shown_.level + 1;
    ++shown_.level;
    shown_.fade = late_ ? std::max(by_height(shown_.level), 1.0f - step) : by_height(shown_.level);
  } else {
    const float least = by_height(shown_.level);
    const bool morphs = late_ || limit > shown_.level;
    shown_.fade = morphs ? std::max(least, shown_.fade - step) : least;
    late_ = late_ && shown_.fade > least;
  }
  wanted_before_ = wanted.level;
  return shown_;
}

void Admission::show(const clipmap::FinestLevel& wanted) {
  shown_ = wanted;
  wanted_before_ = wanted.level;
  late_ = false;
}

}  // namespace globe::render
