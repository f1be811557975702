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
#include "globe/planet/inset_stack.h"
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

OrderKey key_of_cell(int d, int level, int i, int j) {
  const auto finest = [&](int x) {
    return spread_bits(static_cast<std::uint64_t>(x) << (kMaxLevel - level));
  };
  return (static_cast<OrderKey>(d) << 58 | finest(j) << 1 | finest(i)) + 1;
}

/// The first of all keys of nodes of any level that belong to a trixel, or an earlier one.
OrderKey first_key(const LatticeTrixel& t) { return key_of_cell(t.d, t.level, t.cell_i(), t.cell_j()); }

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
  Heights(const Surface& surface, int level, bool by_data)
      : surface_(surface),
        level_(level),
        from_data_(surface.has_data() && (by_data || level <= surface.data_level())) {}

  int level() const { return level_; }
  int blocks() const { return block_level(level_); }  ///< level of their cells
  bool from_data() const { return from_data_; }

  /// The block of the cell that holds a trixel of the block level or a finer one.
  HeightBlock block(const LatticeTrixel& t) {
    HeightBlock block;
    block.d = t.d;
    block.height_level = level_;
    const int up = t.level - blocks();
    const int cells = block.cells();
    block.i0 = (t.cell_i() >> up) * cells;
    block.j0 = (t.cell_j() >> up) * cells;
    if (from_data_) {
      surface_.data_heights(block.d, level_, block.i0, block.j0, cells + 1, cells + 1, block.values.data());
    } else {
      make(block);
    }
    return block;
  }

  double height(const Node& node) const {
    return from_data_ ? surface_.data_height(node) : surface_.height(node);
  }

 private:
  void make(HeightBlock& block) {
    const TileId id = tile_of({block.d, level_, block.i0 + 1, block.j0 + 1});
    if (!tile_ || !(tile_->id == id)) tile_ = surface_.tile(id);
    for (int j = block.j0; j <= block.j0 + block.cells(); ++j)
      for (int i = block.i0; i <= block.i0 + block.cells(); ++i) block.at(i, j) = tile_->height.at(i, j);
  }

  const Surface& surface_;
  int level_;
  bool from_data_;
  std::shared_ptr<const SurfaceTile> tile_;
};

class Summarizer {
 public:
  Summarizer(const Surface& surface, const Region& region, std::optional<int> level)
      : surface_(surface),
        region_(region),
        whole_(surface, level.value_or(surface.data_level()), !level),
        fine_(surface, level.value_or(surface.finest_data_level()), !level),
        has_pyramids_(whole_.from_data() && whole_.level() == surface.data_level() &&
                      has_pyramid("height_range") && has_pyramid("height_mean")),
        cutter_(region) {}

  std::optional<RegionSummary> run() {
    if (!whole_.from_data()) refuse_too_many_tiles();
    for (int d = 0; d < kDiamonds; ++d) {
      for (const int sign : {1, -1}) {
        const LatticeTrixel root{d, 0, sign > 0 ? 0 : 1, sign > 0 ? 0 : 1, sign};
        descend(root, corners(root), nullptr, whole_);
      }
    }
    const int n = nodes_per_side(whole_.level());
    add_pole({0, whole_.level(), 0, 0}, kNorthPole);
    add_pole({0, whole_.level(), n, n}, kSouthPole);
    search_inside();
    resolve_border();
    return result();
  }

 private:
  /// Whether a layer of two numbers a cell goes down to the block level.
  bool has_pyramid(const char* name) const {
    const LayerInfo* layer = surface_.dataset()->layer(name);
    return layer != nullptr && layer->channels == 2 && layer->level >= whole_.blocks();
  }

  void refuse_too_many_tiles() const {
    const int tile_level = std::max(0, whole_.level() - 6);
    std::uint64_t halves = 0;
    htm::visit_cover(region_, {tile_level, false, 0, false}, [&](const htm::IdRange& range) {
      halves += range.last - range.first + 1;
      if (halves > 2 * kSummaryTiles) {
        throw Error("summary",
                    "the region holds more than " + std::to_string(kSummaryTiles) +
                        " tiles of synthesised ground at level " + std::to_string(whole_.level()),
                    "take a smaller region or a lower --level");
      }
    });
  }

  bool touches_inset(const LatticeTrixel& t) const {
    return !surface_.insets().empty() && surface_.insets().highest(t.d, t.level, t.cell_i(), t.cell_j());
  }

  /// Whether a trixel of the planet's own data has to be looked at in those of an inset.
  bool turns_fine(const LatticeTrixel& t, const Heights& heights) const {
    return t.level == heights.level() && heights.level() < fine_.level() && touches_inset(t);
  }

  /// @param block  the heights around the trixel, below the block level
  void descend(const LatticeTrixel& t, const Corners& corners, const HeightBlock* block, Heights& heights) {
    const Relation relation = region_.relation(corners);
    if (relation == Relation::kDisjoint) return;
    if (relation == Relation::kInside) {
      const double area = geo::surface_area(surface_.ellipsoid(), corners);
      area_ += area;
      return add_ground(t, corners, area, block, heights);
    }
    if (turns_fine(t, heights)) return descend(t, corners, nullptr, fine_);
    HeightBlock own;
    if (block == nullptr && t.level >= heights.blocks()) {
      own = heights.block(t);
      block = &own;
    }
    if (t.level == heights.level()) return add_cut(t, corners, *block);
    const auto parts = children(t);
    const auto part_corners = children_corners(corners);
    for (std::size_t k = 0; k < 4; ++k) descend(parts[k], part_corners[k], block, heights);
  }

  /// Mean and extremes of a trixel that is wholly inside.
  void add_ground(const LatticeTrixel& t, const Corners& corners, double area, const HeightBlock* block,
                  Heights& heights) {
    const bool touched = &heights == &whole_ && touches_inset(t);
    if (t.level <= heights.blocks() && &heights == &whole_ && has_pyramids_ && !touched) {
      add_mean(area, static_cast<double>(read("height_mean", t)[t.half() == 0 ? 0 : 1]));
      samples_ += own_nodes(t, heights.level());
      finest_ = std::max(finest_, heights.level());
      inside_.push_back(t);
    } else if (turns_fine(t, heights)) {
      add_ground(t, corners, area, nullptr, fine_);
    } else if (t.level < heights.blocks() ||
               (touched && t.level < heights.level() && heights.level() < fine_.level())) {
      const auto parts = children(t);
      const auto part_corners = children_corners(corners);
      for (std::size_t k = 0; k < 4; ++k)
        add_ground(parts[k], part_corners[k], geo::surface_area(surface_.ellipsoid(), part_corners[k]), block,
                   heights);
    } else if (block == nullptr) {
      const HeightBlock own = heights.block(t);
      add_ground(t, corners, area, &own, heights);
    } else {
      add_mean(area, mean_height(surface_.ellipsoid(), *block, t, corners));
      samples_ += own_nodes(t, heights.level());
      finest_ = std::max(finest_, heights.level());
      for_each_own_node(t, heights.level(), [&](int i, int j) {
        add_node({t.d, heights.level(), i, j}, key_of_cell(t.d, heights.level(), i - 1, j), block->at(i, j));
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
    add_node(node, key, whole_.height(node));
  }

  void add_cut(const LatticeTrixel& t, const Corners& corners, const HeightBlock& block) {
    finest_ = std::max(finest_, t.level);
    cut_.push_back({corners, {block.at(t.i, t.j), block.at(t.i + t.sign, t.j), block.at(t.i, t.j + t.sign)}});
    if (t.sign < 0 || !cutter_.inside(corners[1])) return;
    ++samples_;
    add_node({t.d, t.level, t.i + 1, t.j}, key_of_cell(t.d, t.level, t.i, t.j), cut_.back().heights[1]);
  }

  /// Looks for better nodes inside, best block first. `sign` is 1 for the highest, -1 for the lowest.
  void search_inside(double sign, Best& best) {
    struct BoundedBlock {
      double bound;
      OrderKey key;
      LatticeTrixel trixel;

      bool operator<(const BoundedBlock& other) const {
        return bound < other.bound || (bound == other.bound && key > other.key);
      }
    };
    std::priority_queue<BoundedBlock> queue;
    const auto add = [&](const LatticeTrixel& t) {
      const double bound = sign * static_cast<double>(read("height_range", t)[sign > 0 ? 1 : 0]);
      const OrderKey key = first_key(t);
      if (best.is_beaten_by(bound, key)) queue.push({bound, key, t});
    };
    for (const LatticeTrixel& t : inside_) add(t);
    while (!queue.empty() && best.is_beaten_by(queue.top().bound, queue.top().key)) {
      const LatticeTrixel t = queue.top().trixel;
      queue.pop();
      if (t.level == whole_.blocks()) {
        const HeightBlock block = whole_.block(t);
        const int level = whole_.level();
        for_each_own_node(t, level, [&](int i, int j) {
          best.take(sign * block.at(i, j), key_of_cell(t.d, level, i - 1, j), {t.d, level, i, j});
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
    for (int round = std::max(finest_, whole_.level()); round < htm::kMaxLevel && !is_resolved(); ++round) {
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
    summary.level = std::max(finest_, whole_.level());
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
  Heights whole_;  ///< of the level asked; by the data: of the planet's own
  Heights fine_;   ///< of the finest inset; where there is no inset the same as whole_
  bool has_pyramids_;
  int finest_ = 0;

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

std::optional<RegionSummary> summarize(const Surface& surface, const Region& region,
                                       std::optional<int> level) {
  return Summarizer(surface, region, level).run();
}

}  // namespace globe::planet
