#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "globe/search/feature_index.h"

namespace globe::search {

/// The best hits so far: by (distance, id), so that without distances the order is that of ids.
class HitList {
 public:
  explicit HitList(std::optional<std::size_t> most)
      : most_(most.value_or(std::numeric_limits<std::size_t>::max())) {}

  void add(const Hit& hit) {
    if (most_ == 0) return;
    if (hits_.size() == most_) {
      if (!before(hit, hits_.front())) return;
      std::pop_heap(hits_.begin(), hits_.end(), before);
      hits_.back() = hit;
    } else {
      hits_.push_back(hit);
    }
    // A heap only where the worst will have to make room.
    if (most_ != std::numeric_limits<std::size_t>::max()) std::push_heap(hits_.begin(), hits_.end(), before);
  }

  bool full() const { return hits_.size() == most_; }
  /// Distance of the worst. REQUIRES: full(), at least one.
  double worst_m() const { return hits_.front().distance_m; }

  std::vector<Hit> sorted() && {
    std::sort(hits_.begin(), hits_.end(), before);
    return std::move(hits_);
  }

 private:
  static bool before(const Hit& a, const Hit& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.id < b.id;
  }

  std::size_t most_;
  std::vector<Hit> hits_;
};

}  // namespace globe::search
