#include "converters/sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "converters/footprint.h"
#include "converters/interpolate.h"
#include "converters/node_block.h"

namespace converters {
namespace {

using globe::planet::dvec3;
using globe::planet::kDiamonds;
using globe::planet::Node;
using globe::planet::nodes_per_side;

constexpr int kBlockSide = 64;
constexpr int kBlocksBetweenDrops = 16;
constexpr std::int64_t kMaxWindowSamples = std::int64_t{1} << 21;

struct Rect {
  int i0, j0, ni, nj;
};

/// Sample columns and rows that a rectangle of nodes touches, both ends included.
struct Bounds {
  int x0, y0, x1, y1;
};

/// Moves a column by whole turns to within half a turn of a reference.
int near(const MapGeometry& geometry, int x, int reference) {
  if (x - reference > geometry.period / 2) return x - geometry.period;
  if (reference - x > geometry.period / 2) return x + geometry.period;
  return x;
}

bool is_pole(int level, int i, int j) {
  const int n = nodes_per_side(level);
  return (i == 0 && j == 0) || (i == n && j == n);
}

/// The nodes of one block being sampled: a rectangle inside kBlockSide cells a side.
class BlockSampler {
 public:
  BlockSampler(const SourceMap& map, Filter filter, int d, int level, const Rect& block, const RowSink& sink)
      : map_(map),
        geometry_(map.geometry()),
        filter_(filter),
        d_(d),
        level_(level),
        block_(block),
        side_(std::min(kBlockSide, nodes_per_side(level))),
        cell_i0_(std::min(block.i0 / side_ * side_, nodes_per_side(level) - side_)),
        cell_j0_(std::min(block.j0 / side_ * side_, nodes_per_side(level) - side_)),
        nodes_(d, level, cell_i0_, cell_j0_, side_),
        sink_(sink) {
    for (int j = block.j0; j < block.j0 + block.nj; ++j) {
      for (int i = block.i0; i < block.i0 + block.ni; ++i)
        places_.push_back(place_of(geometry_, nodes_.at(i, j)));
    }
    if (filter == Filter::kArea) find_footprints();
  }

  void run() { run(block_); }

 private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j - block_.j0) * static_cast<std::size_t>(block_.ni) +
           static_cast<std::size_t>(i - block_.i0);
  }

  /// Footprints of all nodes. Those on the block's rim have trixels outside it and take the long way.
  void find_footprints() {
    find_trixel_centres();
    footprints_.resize(places_.size());
    for (int j = block_.j0; j < block_.j0 + block_.nj; ++j) {
      for (int i = block_.i0; i < block_.i0 + block_.ni; ++i) {
        if (is_pole(level_, i, j)) continue;
        const bool inside = i > cell_i0_ && j > cell_j0_ && i < cell_i0_ + side_ && j < cell_j0_ + side_;
        footprints_[index(i, j)] =
            inside ? inner_footprint(i, j) : footprint_of(geometry_, {d_, level_, i, j});
      }
    }
  }

  /// Of both trixels of every cell: the one with the cell's first node, then the other.
  void find_trixel_centres() {
    for (int j = cell_j0_; j < cell_j0_ + side_; ++j) {
      for (int i = cell_i0_; i < cell_i0_ + side_; ++i) {
        const dvec3& a = nodes_.at(i + 1, j);
        const dvec3& b = nodes_.at(i, j + 1);
        centres_.push_back(place_of(geometry_, trixel_centre(nodes_.at(i, j), a, b)));
        centres_.push_back(place_of(geometry_, trixel_centre(nodes_.at(i + 1, j + 1), b, a)));
      }
    }
  }

  Footprint inner_footprint(int i, int j) const {
    const auto first = [&](int ci, int cj) -> const SamplePlace& {
      return centres_[static_cast<std::size_t>(2 * ((cj - cell_j0_) * side_ + (ci - cell_i0_)))];
    };
    const auto second = [&](int ci, int cj) -> const SamplePlace& { return (&first(ci, cj))[1]; };
    return make_footprint(geometry_, places_[index(i, j)],
                          {first(i, j), second(i - 1, j), first(i - 1, j), second(i - 1, j - 1),
                           first(i, j - 1), second(i, j - 1)},
                          6);
  }

  /// Splits the rectangle until its window of the map is of a handy size.
  void run(const Rect& rect) {
    const Bounds bounds = bounds_of(rect);
    const std::int64_t samples =
        (std::int64_t{bounds.x1} - bounds.x0 + 1) * (std::int64_t{bounds.y1} - bounds.y0 + 1);
    if (samples > kMaxWindowSamples && rect.ni > 1 && rect.ni >= rect.nj) {
      run({rect.i0, rect.j0, rect.ni / 2, rect.nj});
      run({rect.i0 + rect.ni / 2, rect.j0, rect.ni - rect.ni / 2, rect.nj});
    } else if (samples > kMaxWindowSamples && rect.nj > 1) {
      run({rect.i0, rect.j0, rect.ni, rect.nj / 2});
      run({rect.i0, rect.j0 + rect.nj / 2, rect.ni, rect.nj - rect.nj / 2});
    } else {
      window_.x0 = bounds.x0;
      window_.y0 = bounds.y0;
      window_.width = bounds.x1 - bounds.x0 + 1;
      window_.height = bounds.y1 - bounds.y0 + 1;
      map_.read(window_);
      sample(rect);
    }
  }

  int reference_column(const Rect& rect) const {
    const bool skip = is_pole(level_, rect.i0, rect.j0);
    return places_[skip ? std::min(index(rect.i0, rect.j0) + 1, places_.size() - 1) : index(rect.i0, rect.j0)]
        .x.whole;
  }

  Bounds bounds_of(const Rect& rect) const {
    constexpr int kFar = 1 << 30;
    Bounds bounds{kFar, kFar, -kFar, -kFar};
    const int reference = reference_column(rect);
    for (int j = rect.j0; j < rect.j0 + rect.nj; ++j) {
      for (int i = rect.i0; i < rect.i0 + rect.ni; ++i) {
        if (is_pole(level_, i, j)) continue;
        const SamplePlace& place = places_[index(i, j)];
        const int x = near(geometry_, place.x.whole, reference);
        Bounds own{x - 1, place.y.whole - 1, x + 2, place.y.whole + 2};
        if (filter_ == Filter::kArea) {
          const Footprint& footprint = footprints_[index(i, j)];
          own = {x + static_cast<int>(std::floor(footprint.min_x())),
                 static_cast<int>(std::floor(footprint.min_y())) - 1,
                 x + static_cast<int>(std::floor(footprint.max_x())) + 1,
                 static_cast<int>(std::floor(footprint.max_y())) + 2};
          // What is averaged reaches half a sample beyond the outermost rows, no further.
          own.y0 = std::max(own.y0, -1);
          own.y1 = std::min(own.y1, geometry_.height);
        }
        bounds = {std::min(bounds.x0, own.x0), std::min(bounds.y0, own.y0), std::max(bounds.x1, own.x1),
                  std::max(bounds.y1, own.y1)};
      }
    }
    return bounds.x0 == kFar ? Bounds{0, 0, 0, 0} : bounds;  // a rectangle of nothing but a pole
  }

  void sample(const Rect& rect) {
    const auto channels = static_cast<std::size_t>(map_.channels());
    const int reference = reference_column(rect);
    row_.resize(static_cast<std::size_t>(rect.ni) * channels);
    for (int j = rect.j0; j < rect.j0 + rect.nj; ++j) {
      for (int i = rect.i0; i < rect.i0 + rect.ni; ++i) {
        float* out = row_.data() + static_cast<std::size_t>(i - rect.i0) * channels;
        if (is_pole(level_, i, j)) {
          std::fill_n(out, channels, 0.0F);  // sample_pole comes afterwards
          continue;
        }
        SamplePlace place = places_[index(i, j)];
        const int x = near(geometry_, place.x.whole, reference);
        if (!value_at(i, j, {{x, place.x.fraction}, place.y}, out)) map_.fill(place, out);
      }
      sink_(rect.i0, j, rect.ni, row_.data());
    }
  }

  bool value_at(int i, int j, const SamplePlace& place, float* out) const {
    switch (filter_) {
      case Filter::kNearest:
        return nearest(window_, map_.channels(), place, out);
      case Filter::kBilinear:
        return bilinear(window_, map_.channels(), place, out);
      case Filter::kBicubic:
        return bicubic(window_, map_.channels(), place, out);
      case Filter::kArea:
        break;
    }
    return footprint_mean(window_, map_.channels(), geometry_, footprints_[index(i, j)], place, out);
  }

  const SourceMap& map_;
  const MapGeometry& geometry_;
  Filter filter_;
  int d_;
  int level_;
  Rect block_;
  int side_;
  int cell_i0_, cell_j0_;  ///< first cell of the block
  NodeBlock nodes_;
  const RowSink& sink_;
  std::vector<SamplePlace> places_;
  std::vector<SamplePlace> centres_;
  std::vector<Footprint> footprints_;
  Window window_;
  std::vector<float> row_;
};

/// The value of a pole, the same in all four diamonds.
void sample_pole(const SourceMap& map, Filter filter, int level, bool north, const RowSink& sink) {
  const MapGeometry& geometry = map.geometry();
  const int at = north ? 0 : nodes_per_side(level);
  const SamplePlace place = place_of(geometry, globe::planet::node_direction({0, level, at, at}));
  std::array<float, 4> value{};
  const bool valid = filter == Filter::kArea
                         ? cap_mean(map, cap_rim(geometry, level, north), north, value.data())
                         : row_mean(map, north ? 0 : geometry.height - 1, value.data());
  if (!valid) map.fill(place, value.data());
  sink(at, at, 1, value.data());
}

/// Blocks from the one that holds node `first` to that of node `last`; the last node of a diamond belongs to
/// the last block.
struct BlockRange {
  int first, count;
};
BlockRange blocks_of(int first, int last, int side, int n) {
  const int from = std::min(first / side, n / side - 1);
  return {from, std::min(last / side, n / side - 1) - from + 1};
}

/// The nodes of a block that lie in a range: `begin` and how many.
std::pair<int, int> nodes_of(int block, int side, int n, int first, int count) {
  const int end = (block + 1) * side == n ? n + 1 : (block + 1) * side;
  const int begin = std::max(first, block * side);
  return {begin, std::min(first + count, end) - begin};
}

}  // namespace

void sample_nodes(const SourceMap& map, Filter filter, const NodeRect& rect, const RowSink& sink,
                  const std::function<void(double)>& progress) {
  const int n = nodes_per_side(rect.level);
  const int side = std::min(kBlockSide, n);
  const BlockRange across = blocks_of(rect.i0, rect.i0 + rect.ni - 1, side, n);
  const BlockRange down = blocks_of(rect.j0, rect.j0 + rect.nj - 1, side, n);
  std::atomic<int> done = 0;
  // Along i first: rows of one diamond then cross the map from north to south, and what is read of it at a
  // time is a band.
  tbb::parallel_for(0, across.count * down.count, [&](int block) {
    const auto [i, ni] = nodes_of(across.first + block / down.count, side, n, rect.i0, rect.ni);
    const auto [j, nj] = nodes_of(down.first + block % down.count, side, n, rect.j0, rect.nj);
    BlockSampler(map, filter, rect.d, rect.level, {i, j, ni, nj}, sink).run();
    const int now = ++done;
    if (now % kBlocksBetweenDrops == 0) {
      map.drop_pages();
      progress(double(now) / (across.count * down.count));
    }
  });
  if (rect.i0 == 0 && rect.j0 == 0) sample_pole(map, filter, rect.level, true, sink);
  if (rect.i0 + rect.ni > n && rect.j0 + rect.nj > n) sample_pole(map, filter, rect.level, false, sink);
}

}  // namespace converters
