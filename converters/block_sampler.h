#pragma once

#include <vector>

#include "converters/footprint.h"
#include "converters/map_stack.h"
#include "converters/node_block.h"

namespace converters {

/// Some nodes of one block: a rectangle inside it.
struct BlockPart {
  int i0, j0, ni, nj;

  std::size_t size() const { return static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj); }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j - j0) * static_cast<std::size_t>(ni) + static_cast<std::size_t>(i - i0);
  }
};

/// Whether a node is one of the poles.
bool is_pole(int level, int i, int j);

/// Samples one map at the nodes of a block.
class BlockSampler {
 public:
  /// Level and diamond are those of the block, which outlives the sampler, as does the map.
  BlockSampler(const MapStack::Entry& entry, const NodeBlock& nodes, const BlockPart& part);

  /// Values of the part's nodes, channels interleaved, and their weights: the share of the filter's weights
  /// that fell on valid samples. Where that is 0 the values are 0.
  void sample(float* values, float* weights);

  /// Whether the map is asked for a node: it lies on the map.
  bool holds(int i, int j) const;

  /// A value for a node that the map holds and that has no weight, from the valid samples around it.
  void fill(int i, int j, float* out) const;

 private:
  /// Sample columns and rows, both ends included; none when x1 < x0.
  struct Bounds {
    int x0, y0, x1, y1;
  };

  bool is_round_pole(int i, int j) const;
  void sample_pole(int i, int j, float* values, float* weights) const;
  void find_footprints();
  void find_centres();
  Footprint inner_footprint(int i, int j) const;
  void sample(const BlockPart& part, float* values, float* weights);
  void sample_window(const BlockPart& part, float* values, float* weights);
  int reference_column(const BlockPart& part) const;
  Bounds reach_of(int i, int j, int x) const;
  Bounds bounds_of(const BlockPart& part) const;
  double value_at(int i, int j, const SamplePlace& place, float* out) const;

  const SourceMap& map_;
  const MapGeometry& geometry_;
  Filter filter_;
  const NodeBlock& nodes_;
  BlockPart part_;
  std::vector<SamplePlace> places_;
  BlockPart cells_{};  ///< whose centres are known
  std::vector<SamplePlace> centres_;
  std::vector<Footprint> footprints_;
  Window window_;
};

}  // namespace converters
