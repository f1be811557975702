#pragma once

#include <cstddef>
#include <vector>

#include "converters/node_rect.h"
#include "converters/sampler.h"

namespace converters {

/// Values at a rectangle of nodes and one node beyond it all around. What lies beyond a diamond's border is
/// the neighbour's, its lattice unfolded (globe::planet::fold).
class GuardedBlock {
 public:
  /// Takes the values from `nodes`. The two guard nodes that no other node of the lattice neighbours, (-1,
  /// -1) and (n+1, n+1), stay 0.
  GuardedBlock(const NodeRect& rect, int channels, const NodeSource& nodes);

  const NodeRect& rect() const { return rect_; }
  int channels() const { return channels_; }
  int stride() const { return rect_.ni + 2; }  ///< nodes from row to row

  float* at(int i, int j) { return values_.data() + index(i, j); }
  const float* at(int i, int j) const { return values_.data() + index(i, j); }
  std::vector<float>& values() { return values_; }  ///< all of them, guard included

 private:
  std::size_t index(int i, int j) const {
    return (static_cast<std::size_t>(j - rect_.j0 + 1) * static_cast<std::size_t>(stride()) +
            static_cast<std::size_t>(i - rect_.i0 + 1)) *
           static_cast<std::size_t>(channels_);
  }
  void take_beyond_border(const NodeSource& nodes);

  NodeRect rect_;
  int channels_;
  std::vector<float> values_;
};

}  // namespace converters
