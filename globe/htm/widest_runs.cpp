#include "globe/htm/widest_runs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

namespace globe::htm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Area of a trixel, steradians (Eriksson 1990).
double area_of(const Corners& t) {
  return 2.0 * std::atan2(glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), t[0]),
                          1.0 + glm::dot(t[0], t[1]) + glm::dot(t[1], t[2]) + glm::dot(t[2], t[0]));
}

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Ids of the level asked for, in rising order: all wanted, or those of a trixel that is partly so. What lies
/// between two pieces is not wanted.
struct Piece {
  std::uint64_t first = 0, last = 0;
  double area = 0;
  std::uint32_t open = kNone;  ///< number of the trixel, if partly wanted

  bool is_open() const { return open != kNone; }
};

struct OpenTrixel {
  Trixel trixel;
  Corners corners;
};

class Search {
 public:
  Search(const Region& region, int level, Relation wanted, std::size_t count, bool with_ends)
      : region_(region),
        level_(level),
        wanted_(wanted),
        count_(count),
        with_ends_(with_ends),
        first_id_(kFirstRoot << (2 * level)),
        last_id_(((kFirstRoot + kRoots) << (2 * level)) - 1) {}

  std::vector<Run> run() {
    for (std::uint64_t root = kFirstRoot; root < kFirstRoot + kRoots; ++root)
      classify({root}, corners({root}), 0.5 * std::numbers::pi, level_);
    for (int below = level_ - 1; below >= 0 && drop_hopeless(); --below) split(below);
    return choose();
  }

 private:
  bool is_end(const Piece& piece) const {
    return with_ends_ && (piece.first == first_id_ || piece.last == last_id_);
  }

  static bool meet(const Piece& a, const Piece& b) { return a.last + 1 == b.first; }

  void append(const Piece& piece) {
    if (!piece.is_open() && !pieces_.empty() && !pieces_.back().is_open() && meet(pieces_.back(), piece)) {
      pieces_.back().last = piece.last;
      pieces_.back().area += piece.area;
    } else {
      pieces_.push_back(piece);
    }
  }

  void classify(Trixel t, const Corners& corners, double area, int levels_below) {
    const Relation relation = region_.relation(corners);
    const bool open = relation == Relation::kTouches && levels_below > 0;
    if (!open && relation != wanted_) return;
    const int shift = 2 * levels_below;
    append({t.id << shift, ((t.id + 1) << shift) - 1, area,
            open ? static_cast<std::uint32_t>(open_.size()) : kNone});
    if (open) open_.push_back({t, corners});
  }

  void split(int levels_below) {
    constexpr double kFlat = 1e-3;  // steradians; the children of smaller trixels are equal to some per cent
    coarse_pieces_.swap(pieces_);
    coarse_.swap(open_);
    pieces_.clear();
    open_.clear();
    for (const Piece& piece : coarse_pieces_) {
      if (!piece.is_open()) {
        append(piece);
        continue;
      }
      const auto& [trixel, corners] = coarse_[piece.open];
      const std::array<Corners, 4> children = children_corners(corners);
      for (std::size_t k = 0; k < 4; ++k) {
        const double area = piece.area > kFlat ? area_of(children[k]) : 0.25 * piece.area;
        classify({trixel.id << 2 | k}, children[k], area, levels_below);
      }
    }
  }

  const Piece* before(std::size_t k) const {
    return k > 0 && meet(pieces_[k - 1], pieces_[k]) ? &pieces_[k - 1] : nullptr;
  }
  const Piece* after(std::size_t k) const {
    return k + 1 < pieces_.size() && meet(pieces_[k], pieces_[k + 1]) ? &pieces_[k + 1] : nullptr;
  }

  /// A bound of the wanted run that the open piece k may become part of towards `next`, k left out. An open
  /// piece is partly unwanted, so that no run goes on beyond one. Infinite for an end, which is always
  /// chosen.
  double reach(const Piece& piece, const Piece* next, const Piece* beyond) const {
    if (next == nullptr) return is_end(piece) ? kInfinity : 0.0;
    if (next->is_open()) return next->area;
    return is_end(*next) ? kInfinity : next->area + (beyond == nullptr ? 0.0 : beyond->area);
  }

  double widest_through(std::size_t k) const {
    const Piece* previous = before(k);
    const Piece* next = after(k);
    const double back = reach(pieces_[k], previous, previous == nullptr ? nullptr : before(k - 1));
    const double forth = reach(pieces_[k], next, next == nullptr ? nullptr : after(k + 1));
    return pieces_[k].area + std::max(back, forth);
  }

  /// Drops the open pieces that cannot widen or become a chosen run. False when the rest is not worth it.
  bool drop_hopeless() {
    constexpr double kWorthwhile = 1e-3;
    constexpr double kSphere = 4.0 * std::numbers::pi;
    std::vector<double> areas;
    double chosen_area = 0;  // of the ends, and of the widest runs so far
    for (const Piece& piece : pieces_) {
      if (!piece.is_open() && is_end(piece)) chosen_area += piece.area;
      if (!piece.is_open() && !is_end(piece)) areas.push_back(piece.area);
    }
    double narrowest = count_ == 0 ? kInfinity : 0.0;
    const bool enough = areas.size() >= count_;
    if (enough && count_ > 0) {
      const auto last = areas.begin() + static_cast<std::ptrdiff_t>(count_ - 1);
      std::nth_element(areas.begin(), last, areas.end(), std::greater<>());
      narrowest = *last;
      chosen_area = std::accumulate(areas.begin(), last + 1, chosen_area);
    }
    double open_area = 0;
    std::vector<bool> hopeless(pieces_.size());
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (!pieces_[k].is_open()) continue;
      const double widest = widest_through(k);
      hopeless[k] = widest <= narrowest && widest < kInfinity;
      if (!hopeless[k]) open_area += pieces_[k].area;
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (!hopeless[k]) pieces_[kept++] = pieces_[k];
    pieces_.resize(kept);
    const double cover_area = wanted_ == Relation::kInside ? chosen_area : kSphere - chosen_area;
    return open_area > (enough ? kWorthwhile * cover_area : 0.0);
  }

  std::vector<Run> choose() const {
    std::vector<Run> runs, ends;
    for (const Piece& piece : pieces_)
      if (!piece.is_open()) (is_end(piece) ? ends : runs).push_back({piece.first, piece.last, piece.area});
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
      return a.area != b.area ? a.area > b.area : a.first < b.first;
    });
    if (runs.size() > count_) runs.resize(count_);
    runs.insert(runs.end(), ends.begin(), ends.end());
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.first < b.first; });
    return runs;
  }

  const Region& region_;
  int level_;
  Relation wanted_;
  std::size_t count_;
  bool with_ends_;
  std::uint64_t first_id_, last_id_;
  std::vector<Piece> pieces_, coarse_pieces_;
  std::vector<OpenTrixel> open_, coarse_;
};

}  // namespace

std::vector<Run> widest_runs(const Region& region, int level, Relation wanted, std::size_t count,
                             bool with_ends) {
  return Search(region, level, wanted, count, with_ends).run();
}

}  // namespace globe::htm
