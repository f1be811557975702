#include "globe/planet/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "globe/base/error.h"
#include "globe/geo/area.h"
#include "globe/htm/cover.h"
#include "globe/planet/border_cut.h"
#include "globe/planet/mean_height.h"

namespace globe::planet {
namespace {

using htm::Corners;
using htm::Region;
using htm::Relation;

/// Trixels on the border are cut until there are so many of them and little of the area is in them, or there
/// are kMostCut.
constexpr std::size_t kEnoughCut = 2048;
constexpr std::size_t kMostCut = std::size_t{1} << 17;
constexpr double kSmallShare = 0.02;

/// Place of a node in the order of the grid. Each node but the poles belongs to one cell, whose corner
/// (i + 1, j) it is, by that of its names that has 1 <= i and j < n; in the cell, to half 0.
using OrderKey = std::uint64_t;
constexpr OrderKey kNorthPole = 0;
constexpr OrderKey kSouthPole = ~OrderKey{0};

std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 16) & 0x0000FFFF0000FFFFU;
  v = (v | v << 8) & 0x00FF00FF00FF00FFU;
  v = (v | v << 4) & 0x0F0F0F0F0F0F0F0FU;
  v = (v | v << 2) & 0x3333333333333333U;
  return (v | v << 1) & 0x5555555555555555U;
}

OrderKey key_of_cell(int d, int i, int j) {
  return (static_cast<OrderKey>(d) << 58 | spread_bits(static_cast<std::uint64_t>(j)) << 1 |
          spread_bits(static_cast<std::uint64_t>(i))) +
         1;
}

/// The first of all keys of nodes that belong to a trixel, or an earlier one.
OrderKey first_key(const LatticeTrixel& t, int level) {
  const int below = level - t.level;
  return key_of_cell(t.d, t.cell_i() << below, t.cell_j() << below);
}

/// Calls visit(i, j) for the nodes of a level that belong to a trixel.
template <typename Visit>
void for_each_own_node(const LatticeTrixel& t, int level, const Visit& visit) {
  const int m = 1 << (level - t.level);
  const int i = m * t.i, j = m * t.j;
  if (t.sign > 0) {
    for (int b = 0; b < m; ++b)
      for (int a = 0; a + b < m; ++a) visit(i + a + 1, j + b);
  } else {
    for (int b = 1; b < m; ++b)
      for (int a = 1; a + b <= m; ++a) visit(i - a + 1, j - b);
  }
}

std::uint64_t own_nodes(const LatticeTrixel& t, int level) {
  const std::uint64_t m = std::uint64_t{1} << (level - t.level);
  return t.sign > 0 ? m * (m + 1) / 2 : m * (m - 1) / 2;
}

/// The best height so far and its node. Heights are negated where the lowest is sought.
struct Best {
  double height = -HUGE_VAL;
  OrderKey key = kSouthPole;
  Node node;

  bool is_beaten_by(double other, OrderKey other_key) const {
    return other > height || (other == height && other_key < key);
  }
  void take(double other, OrderKey other_key, const Node& other_node) {
    if (is_beaten_by(other, other_key)) *this = {other, other_key, other_node};
  }
};

/// Heights of a level in blocks.
class Heights {
 public:
  Heights(const Surface& surface, int level) : surface_(surface), level_(level) {}

  bool on_disk() const { return surface_.dataset() != nullptr && level_ <= surface_.data_level(); }

  /// The block of the cell that holds a trixel of the block level or a finer one.
  HeightBlock block(const LatticeTrixel& t) {
    HeightBlock block;
    block.d = t.d;
    block.height_level = level_;
    const int up = t.level - block_level(level_);
    const int cells = block.cells();
    block.i0 = (t.cell_i() >> up) * cells;
    block.j0 = (t.cell_j() >> up) * cells;
    if (on_disk()) {
      read(block);
    } else {
      make(block);
    }
    return block;
  }

 private:
  void read(HeightBlock& block) const {
    std::array<float, (kBlockCells + 1) * (kBlockCells + 1)> values;
    const int side = block.cells() + 1;
    surface_.dataset()->read("height", block.d, level_, block.i0, block.j0, side, side, values.data());
    std::copy_n(values.begin(), side * side, block.values.begin());
  }

  void make(HeightBlock& block) {
    const TileId id = tile_of({block.d, level_, block.i0 + 1, block.j0 + 1});
    if (!tile_ || !(tile_->id == id)) tile_ = surface_.tile(id);
    for (int j = block.j0; j <= block.j0 + block.cells(); ++j)
      for (int i = block.i0; i <= block.i0 + block.cells(); ++i) block.at(i, j) = tile_->height.at(i, j);
  }

  const Surface& surface_;
  int level_;
  std::shared_ptr<const SurfaceTile> tile_;
};

class Summarizer {
 public:
  Summarizer(const Surface& surface, const Region& region, int level)
      : surface_(surface),
        region_(region),
        level_(level),
        block_level_(block_level(level)),
        heights_(surface, level),
        has_pyramids_(heights_.on_disk() && level == surface.data_level() && has_pyramid("height_range") &&
                      has_pyramid("height_mean")),
        cutter_(region) {}

  std::optional<RegionSummary> run() {
    if (!heights_.on_disk()) refuse_too_many_tiles();
    for (int d = 0; d < kDiamonds; ++d) {
      for (const int sign : {1, -1}) {
        const LatticeTrixel root{d, 0, sign > 0 ? 0 : 1, sign > 0 ? 0 : 1, sign};
        descend(root, corners(root), nullptr);
      }
    }
    add_pole({0, level_, 0, 0}, kNorthPole);
    add_pole({0, level_, nodes_per_side(level_), nodes_per_side(level_)}, kSouthPole);
    search_inside();
    resolve_border();
    return result();
  }

 private:
  /// Whether a layer of two numbers a cell goes down to the block level.
  bool has_pyramid(const char* name) const {
    const LayerInfo* layer = surface_.dataset()->layer(name);
    return layer != nullptr && layer->channels == 2 && layer->level >= block_level_;
  }

  void refuse_too_many_tiles() const {
    const int tile_level = std::max(0, level_ - 6);
    std::uint64_t halves = 0;
    htm::visit_cover(region_, {tile_level, false, 0, false}, [&](const htm::IdRange& range) {
      halves += range.last - range.first + 1;
      if (halves > 2 * kSummaryTiles) {
        throw Error("summary",
                    "the region holds more than " + std::to_string(kSummaryTiles) +
                        " tiles of synthesised ground at level " + std::to_string(level_),
                    "take a smaller region or a lower --level");
      }
    });
  }

  /// @param block  the heights around the trixel, below the block level
  void descend(const LatticeTrixel& t, const Corners& corners, const HeightBlock* block) {
    const Relation relation = region_.relation(corners);
    if (relation == Relation::kDisjoint) return;
    if (relation == Relation::kInside) {
      const double area = geo::surface_area(surface_.ellipsoid(), corners);
      area_ += area;
      samples_ += own_nodes(t, level_);
      return add_ground(t, corners, area, block);
    }
    HeightBlock own;
    if (t.level == block_level_) {
      own = heights_.block(t);
      block = &own;
    }
    if (t.level == level_) return add_cut(t, corners, *block);
    const auto parts = children(t);
    const auto part_corners = children_corners(corners);
    for (std::size_t k = 0; k < 4; ++k) descend(parts[k], part_corners[k], block);
  }

  /// Mean and extremes of a trixel that is wholly inside.
  void add_ground(const LatticeTrixel& t, const Corners& corners, double area, const HeightBlock* block) {
    if (t.level <= block_level_ && has_pyramids_) {
      add_mean(area, static_cast<double>(read("height_mean", t)[t.half() == 0 ? 0 : 1]));
      inside_.push_back(t);
    } else if (t.level < block_level_) {
      const auto parts = children(t);
      const auto part_corners = children_corners(corners);
      for (std::size_t k = 0; k < 4; ++k)
        add_ground(parts[k], part_corners[k], geo::surface_area(surface_.ellipsoid(), part_corners[k]),
                   nullptr);
    } else if (block == nullptr) {
      const HeightBlock own = heights_.block(t);
      add_ground(t, corners, area, &own);
    } else {
      add_mean(area, mean_height(surface_.ellipsoid(), *block, t, corners));
      for_each_own_node(t, level_, [&](int i, int j) {
        add_node({t.d, level_, i, j}, key_of_cell(t.d, i - 1, j), block->at(i, j));
      });
    }
  }

  /// The sample of a pyramid's layer for the cell that a trixel lies in.
  std::array<float, 2> read(const char* layer, const LatticeTrixel& t) const {
    std::array<float, 2> sample;
    surface_.dataset()->read(layer, t.d, t.level, t.cell_i(), t.cell_j(), 1, 1, sample.data());
    return sample;
  }

  void add_mean(double area, double mean) {
    mean_area_ += area;
    mean_sum_ += area * mean;
  }

  void add_node(const Node& node, OrderKey key, double height) {
    highest_.take(height, key, node);
    lowest_.take(-height, key, node);
  }

  void add_pole(const Node& node, OrderKey key) {
    if (!region_.contains(node_direction(node))) return;
    ++samples_;
    add_node(node, key, surface_.height(node));
  }

  void add_cut(const LatticeTrixel& t, const Corners& corners, const HeightBlock& block) {
    cut_.push_back({corners, {block.at(t.i, t.j), block.at(t.i + t.sign, t.j), block.at(t.i, t.j + t.sign)}});
    if (t.sign < 0 || !cutter_.inside(corners[1])) return;
    ++samples_;
    add_node({t.d, level_, t.i + 1, t.j}, key_of_cell(t.d, t.i, t.j), cut_.back().heights[1]);
  }

  /// Looks for better nodes inside, best block first. `sign` is 1 for the highest, -1 for the lowest.
  void search_inside(double sign, Best& best) {
    struct Candidate {
      double bound;
      OrderKey key;
      LatticeTrixel trixel;

      bool operator<(const Candidate& other) const {
        return bound < other.bound || (bound == other.bound && key > other.key);
      }
    };
    std::priority_queue<Candidate> queue;
    const auto add = [&](const LatticeTrixel& t) {
      const double bound = sign * static_cast<double>(read("height_range", t)[sign > 0 ? 1 : 0]);
      const OrderKey key = first_key(t, level_);
      if (best.is_beaten_by(bound, key)) queue.push({bound, key, t});
    };
    for (const LatticeTrixel& t : inside_) add(t);
    while (!queue.empty() && best.is_beaten_by(queue.top().bound, queue.top().key)) {
      const LatticeTrixel t = queue.top().trixel;
      queue.pop();
      if (t.level == block_level_) {
        const HeightBlock block = heights_.block(t);
        for_each_own_node(t, level_, [&](int i, int j) {
          best.take(sign * block.at(i, j), key_of_cell(t.d, i - 1, j), {t.d, level_, i, j});
        });
      } else {
        for (const LatticeTrixel& part : children(t)) add(part);
      }
    }
  }

  void search_inside() {
    search_inside(1.0, highest_);
    search_inside(-1.0, lowest_);
  }

  /// Cuts the trixels on the border smaller, and those that are left along straight lines.
  void resolve_border() {
    for (int level = level_; level < htm::kMaxLevel && !is_resolved(); ++level) {
      std::vector<CutTrixel> finer;
      for (const CutTrixel& t : cut_) {
        for (const CutTrixel& part : t.parts()) {
          const Relation relation = region_.relation(part.corners);
          if (relation == Relation::kTouches) finer.push_back(part);
          if (relation == Relation::kInside) add_piece(part, {1.0, part.mean()});
        }
      }
      cut_ = std::move(finer);
    }
    const int halvings = cut_.size() < 2 * kEnoughCut ? 6 : 3;
    for (const CutTrixel& t : cut_) add_piece(t, cutter_.inner_piece(t, halvings));
  }

  bool is_resolved() const {
    if (cut_.empty() || cut_.size() >= kMostCut) return true;
    if (cut_.size() < kEnoughCut) return false;
    double cut_area = 0;
    for (const CutTrixel& t : cut_) cut_area += geo::surface_area(surface_.ellipsoid(), t.corners);
    return cut_area <= kSmallShare * area_;
  }

  void add_piece(const CutTrixel& t, const Piece& piece) {
    if (piece.share == 0.0) return;
    const double area = piece.share * geo::surface_area(surface_.ellipsoid(), t.corners);
    area_ += area;
    add_mean(area, piece.mean_m);
    if (samples_ > 0) return;
    for (std::size_t k = 0; k < 3; ++k)
      if (cutter_.inside(t.corners[k])) add_spot({t.heights[k], t.corners[k]});
  }

  /// A place of the linear surface, for regions without a node.
  void add_spot(const HeightAt& spot) {
    if (!any_spot_ || spot.height_m < lowest_spot_.height_m) lowest_spot_ = spot;
    if (!any_spot_ || spot.height_m > highest_spot_.height_m) highest_spot_ = spot;
    any_spot_ = true;
  }

  std::optional<RegionSummary> result() {
    RegionSummary summary;
    summary.level = level_;
    summary.samples = samples_;
    summary.area_m2 = area_;
    if (samples_ > 0) {
      summary.lowest = {-lowest_.height, node_direction(lowest_.node)};
      summary.highest = {highest_.height, node_direction(highest_.node)};
    } else {
      if (!any_spot_ && cut_.empty()) return std::nullopt;
      if (!any_spot_) add_spot({cut_.front().mean(), cut_.front().center()});
      summary.lowest = lowest_spot_;
      summary.highest = highest_spot_;
    }
    summary.mean_m = mean_area_ > 0.0 ? mean_sum_ / mean_area_ : summary.lowest.height_m;
    return summary;
  }

  const Surface& surface_;
  const Region& region_;
  int level_, block_level_;
  Heights heights_;
  bool has_pyramids_;

  std::uint64_t samples_ = 0;
  double area_ = 0;                      ///< of all that is counted
  double mean_area_ = 0, mean_sum_ = 0;  ///< the same in the pieces that means are known of
  Best highest_, lowest_;                ///< of nodes; lowest_ with its sign changed
  std::vector<LatticeTrixel> inside_;    ///< largest trixels inside, not finer than the block level
  std::vector<CutTrixel> cut_;           ///< on the border
  BorderCutter cutter_;
  bool any_spot_ = false;
  HeightAt lowest_spot_, highest_spot_;
};

}  // namespace

std::optional<RegionSummary> summarize(const Surface& surface, const Region& region, int level) {
  return Summarizer(surface, region, level).run();
}

}  // namespace globe::planet
