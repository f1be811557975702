#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "converters/source_map.h"

namespace converters {

enum class Filter { kNearest, kBilinear, kBicubic, kArea };

/// The maps of one layer in the order given, all of one kind: later ones lie over earlier ones.
class MapStack {
 public:
  struct Entry {
    std::shared_ptr<const SourceMap> map;
    Filter filter;
  };

  void add(std::shared_ptr<const SourceMap> map, Filter filter) {
    entries_.push_back({std::move(map), filter});
  }

  /// Lowest first.
  const std::vector<Entry>& entries() const { return entries_; }

  /// REQUIRES: not empty.
  int channels() const { return entries_.front().map->channels(); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace converters
