#pragma once

#include "converters/buffer.h"
#include "globe/planet/grid.h"

namespace converters {

/// Values at every node of one level, four diamonds, row j major, channels interleaved.
template <typename T>
class NodeGrid {
 public:
  NodeGrid(int level, int channels, MemoryBudget& budget)
      : level_(level), channels_(channels), buffer_(4 * diamond_size() * sizeof(T), budget) {}

  /// Those that a LevelFile holds.
  NodeGrid(int level, int channels, const std::filesystem::path& file)
      : level_(level), channels_(channels), buffer_(file, 4 * diamond_size() * sizeof(T)) {}

  int level() const { return level_; }
  int channels() const { return channels_; }
  int side() const { return globe::planet::nodes_per_side(level_) + 1; }  ///< nodes

  T* diamond(int d) { return buffer_.template as<T>() + static_cast<std::size_t>(d) * diamond_size(); }
  const T* diamond(int d) const { return const_cast<NodeGrid*>(this)->diamond(d); }

  T* at(int d, int i, int j) {
    const auto node =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(side()) + static_cast<std::size_t>(i);
    return diamond(d) + node * static_cast<std::size_t>(channels_);
  }
  const T* at(int d, int i, int j) const { return const_cast<NodeGrid*>(this)->at(d, i, j); }

  void drop_pages() const { buffer_.drop_pages(); }

 private:
  std::size_t diamond_size() const {
    return static_cast<std::size_t>(side()) * static_cast<std::size_t>(side()) *
           static_cast<std::size_t>(channels_);
  }

  int level_;
  int channels_;
  Buffer buffer_;
};

}  // namespace converters
