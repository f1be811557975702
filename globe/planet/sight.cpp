#include "globe/planet/sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "globe/htm/trixel.h"
#include "globe/planet/cell.h"
#include "globe/planet/inset_stack.h"

namespace globe::planet {
namespace {

/// A ray so far below the ground touches it, shares of the eyes' distance from the centre: 50 nm on the
/// Earth, a few roundings of its place.
constexpr double kTouch = 8e-15;
constexpr double kClearance = 1e-8;     ///< metres that the least clearance may be off
constexpr double kShortest = 1e-3;      ///< metres of ray that are not halved any more
constexpr double kBuiltinRelief = 9e3;  ///< metres: the built-in planet's, see COMMANDS, PLANET

/// Of an interval of ray no longer than this, in radii, the track is taken for the arc between its ends: 10
/// km on the Earth. Off the sphere it bends aside from that arc by less than (1 - q) s² / (4 q² b), s its
/// length, b the least radius and q the ratio of the radii: 13 mm on the Earth, where 8 were seen among
/// 600,000.
constexpr double kLongestArc = 1.0 / 640.0;
constexpr double kSteepest = 10.0;  ///< slope up to which ground beside such an arc is allowed for

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The ground within one trixel of the level.
class TrixelGround {
 public:
  TrixelGround(const Surface& surface, htm::Trixel trixel, bool by_data) {
    const Cell cell = cell_from_trixel(trixel);
    const auto node = [&](int di, int dj) { return Node{cell.d, cell.level, cell.i + di, cell.j + dj}; };
    const std::array<Node, 3> nodes{cell.half == 0 ? node(0, 0) : node(1, 1), node(1, 0), node(0, 1)};
    for (std::size_t k = 0; k < 3; ++k) {
      corners_[k] = node_direction(nodes[k]);
      heights_[k] = surface.drawn_height(by_data ? surface.data_height(nodes[k]) : surface.height(nodes[k]));
    }
  }

  /// Linear in the flat trixel, met by the direction u.
  double height(const dvec3& u) const {
    const auto side = [&](std::size_t k, std::size_t l) {
      return glm::dot(glm::cross(corners_[k] - u, corners_[l] - u), u);
    };
    const std::array<double, 3> w{side(1, 2), side(2, 0), side(0, 1)};
    return (w[0] * heights_[0] + w[1] * heights_[1] + w[2] * heights_[2]) / (w[0] + w[1] + w[2]);
  }

 private:
  std::array<dvec3, 3> corners_;
  std::array<double, 3> heights_{};
};

/// The ground of a level, trixels kept as they are met.
class LevelGround {
 public:
  LevelGround(const Surface& surface, const SightSettings& settings)
      : surface_(surface), level_(settings.level), by_data_(settings.by_data && surface.has_data()) {}

  /// The trixel in which the ground around a place is linear.
  htm::Trixel around(const dvec3& u) const {
    if (by_data_ && level_ > surface_.data_level()) {
      const htm::Trixel own = htm::trixel_at(u, surface_.data_level());
      if (!highest_inset(own)) return own;
    }
    return htm::trixel_at(u, level_);
  }

  const TrixelGround& of(htm::Trixel trixel) {
    constexpr std::size_t kMostKept = 65536;
    if (trixels_.size() > kMostKept) trixels_.clear();
    return trixels_.try_emplace(trixel, surface_, trixel, by_data_).first->second;
  }

  /// A bound of the ground within a trixel of the level or a coarser one; of all ground without one.
  double bound(std::optional<htm::Trixel> trixel) {
    const double highest = known_bound(trixel);
    return surface_.has_sea() ? std::max(highest, 0.0) : highest;
  }

 private:
  std::optional<double> highest_inset(htm::Trixel trixel) const {
    if (surface_.insets().empty()) return std::nullopt;
    const Cell cell = cell_from_trixel(trixel);
    return surface_.insets().highest(cell.d, cell.level, cell.i, cell.j);
  }

  double known_bound(std::optional<htm::Trixel> trixel) {
    if (surface_.dataset() == nullptr || (!by_data_ && level_ > surface_.data_level())) {
      const double whole = surface_.dataset() == nullptr ? kBuiltinRelief : kUnbounded;
      return trixel && level_ > surface_.data_level() ? std::min(whole, tile_bound(*trixel)) : whole;
    }
    const double own = own_data_bound(trixel);
    const std::optional<double> inset = trixel ? highest_inset(*trixel) : surface_.insets().highest();
    return inset ? std::max(own, *inset) : own;
  }

  /// Of the planet's own data.
  double own_data_bound(std::optional<htm::Trixel> trixel) const {
    const Dataset* dataset = surface_.dataset();
    const LayerInfo* ranges = dataset->layer("height_range");
    if (!trixel || ranges == nullptr) return dataset->layer("height")->max;
    const Cell cell = cell_from_trixel(*trixel);
    const int up = std::max(cell.level - ranges->level, 0);
    std::array<float, 2> range{};
    dataset->read("height_range", cell.d, cell.level - up, cell.i >> up, cell.j >> up, 1, 1, range.data());
    return static_cast<double>(range[1]);
  }

  /// Below the data: the highest node of the tile of the level that holds the trixel, if one does.
  double tile_bound(htm::Trixel trixel) {
    const Cell cell = cell_from_trixel(trixel);
    const int down = level_ - cell.level;
    const TileId whole{cell.d, level_, 0, 0};
    if (nodes_per_side(down) > whole.cells()) return kUnbounded;
    const TileId id{cell.d, level_, (cell.i << down) / whole.cells(), (cell.j << down) / whole.cells()};
    const auto [known, fresh] = tiles_.try_emplace(tile_key(id), 0.0);
    if (fresh) {
      const auto tile = surface_.tile(id);
      known->second = *std::max_element(tile->height.values.begin(), tile->height.values.end());
    }
    return known->second;
  }

  static std::uint64_t tile_key(const TileId& id) {
    return (static_cast<std::uint64_t>(id.d) << 60) | (static_cast<std::uint64_t>(id.ti) << 30) |
           static_cast<std::uint64_t>(id.tj);
  }

  const Surface& surface_;
  int level_;
  bool by_data_;
  std::unordered_map<htm::Trixel, TrixelGround> trixels_;
  std::unordered_map<std::uint64_t, double> tiles_;  ///< of `level_`
};

/// The ray at a distance from its first eye.
struct RayPoint {
  double s = 0;         ///< metres, along the straight line
  double straight = 0;  ///< height of the straight line above the ellipsoid, metres
  double clearance = 0;
  geo::Geodetic place;  ///< h_m is the ray's
  htm::Trixel trixel;   ///< in which the ground around it is linear
};

/// A piece of the ray, and what its clearance cannot fall below.
struct Interval {
  RayPoint begin, end;
  double least = 0;
};

struct WorstFirst {
  bool operator()(const Interval& a, const Interval& b) const { return a.least > b.least; }
};

class Ray {
 public:
  Ray(const Surface& surface, const geo::Geodetic& from, const geo::Geodetic& to,
      const SightSettings& settings)
      : surface_(surface),
        settings_(settings),
        ground_(surface, settings),
        a_(geo::ecef_from_geodetic(surface.ellipsoid(), from)),
        b_(geo::ecef_from_geodetic(surface.ellipsoid(), to)),
        length_(glm::distance(a_, b_)),
        begin_(point(0.0, from)),
        end_(point(length_, to)) {
    const double a = surface.ellipsoid().a, b = surface.ellipsoid().b();
    least_radius_ = std::min(b * (b / a), a * (a / b));
    const double least = std::min(a, b), ratio = least / std::max(a, b);
    longest_arc_ = kLongestArc * least;
    slack_ = kSteepest * (1.0 - ratio) * longest_arc_ * longest_arc_ / (4.0 * ratio * ratio * least);
    touch_ = kTouch * std::max(glm::length(a_), glm::length(b_));
  }

  double length() const { return length_; }
  bool is_clear(const RayPoint& point) const { return point.clearance >= -touch_; }
  const RayPoint& begin() const { return begin_; }
  const RayPoint& end() const { return end_; }

  /// Where the clearance is least.
  RayPoint lowest() {
    RayPoint best = end_.clearance < begin_.clearance ? end_ : begin_;
    std::priority_queue<Interval, std::vector<Interval>, WorstFirst> open;
    open.push({begin_, end_, least(begin_, end_)});
    while (!open.empty() && open.top().least < best.clearance - kClearance) {
      const Interval worst = open.top();
      open.pop();
      if (worst.end.s - worst.begin.s < kShortest) continue;
      const RayPoint middle = between(worst.begin, worst.end);
      if (middle.clearance < best.clearance) best = middle;
      open.push({worst.begin, middle, least(worst.begin, middle)});
      open.push({middle, worst.end, least(middle, worst.end)});
    }
    return best;
  }

  /// The first place below ground on the way from `near` to `far`, two points of the ray in either order.
  std::optional<RayPoint> first_blocked(const RayPoint& near, const RayPoint& far) {
    if (!is_clear(near)) return near;
    const bool forward = near.s < far.s;
    if ((forward ? least(near, far) : least(far, near)) >= -touch_) return std::nullopt;
    if (std::abs(far.s - near.s) < kShortest) return is_clear(far) ? std::nullopt : std::optional(far);
    const RayPoint middle = forward ? between(near, far) : between(far, near);
    if (const auto found = first_blocked(near, middle)) return found;
    return first_blocked(middle, far);
  }

 private:
  /// @param place  h_m that of the straight line
  RayPoint point(double s, const geo::Geodetic& place) {
    const dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
    RayPoint result{s, place.h_m, 0.0, place, ground_.around(u)};
    result.place.h_m += raised(s);
    result.clearance = result.place.h_m - ground_.of(result.trixel).height(u);
    return result;
  }

  RayPoint between(const RayPoint& begin, const RayPoint& end) {
    const double s = 0.5 * (begin.s + end.s);
    const double share = s / length_;
    return point(s, geo::geodetic_from_ecef(surface_.ellipsoid(), (1.0 - share) * a_ + share * b_));
  }

  double raised(double s) const {
    return settings_.refraction * s * (length_ - s) / (2.0 * surface_.ellipsoid().mean_radius());
  }

  /// A lower bound of the clearance between two points of the ray.
  double least(const RayPoint& begin, const RayPoint& end) {
    const double length = end.s - begin.s;
    // No point is farther than half the length from an end, and heights change no faster than points do.
    const double deepest = std::min(begin.straight, end.straight) - 0.5 * length;
    const double radius = least_radius_ + deepest;
    double sag = 0.5 * length;  // of the ray below the line through its ends
    if (radius > 0.0) {
      // Linear ground over a flat trixel bends by less than a hundredth of the ellipsoid's curvature.
      constexpr double kWithGround = 1.01;
      const double bend = kWithGround / radius - settings_.refraction / surface_.ellipsoid().mean_radius();
      sag = std::min(sag, std::max(bend, 0.0) * length * length / 8.0);
    }
    const double ray = std::min(begin.place.h_m, end.place.h_m) - sag;
    if (length > longest_arc_) return ray - ground_.bound(std::nullopt);
    if (begin.trixel == end.trixel) return std::min(begin.clearance, end.clearance) - sag;
    return ray - ground_.bound(common_ancestor(begin.trixel, end.trixel)) - slack_;
  }

  /// The smallest trixel that holds two; none across the octahedron's edges.
  static std::optional<htm::Trixel> common_ancestor(htm::Trixel a, htm::Trixel b) {
    while (htm::level(a) > htm::level(b)) a = htm::parent(a);
    while (htm::level(b) > htm::level(a)) b = htm::parent(b);
    while (a != b) {
      if (htm::level(a) == 0) return std::nullopt;
      a = htm::parent(a);
      b = htm::parent(b);
    }
    return a;
  }

  const Surface& surface_;
  SightSettings settings_;
  LevelGround ground_;
  dvec3 a_, b_;
  double length_;
  double least_radius_ = 0;  ///< of curvature, of the ellipsoid
  double longest_arc_ = 0;   ///< metres
  double slack_ = 0;         ///< metres that ground beside a track may be higher than on it
  double touch_ = 0;         ///< metres
  RayPoint begin_, end_;
};

/// One of the two orders of a pair, so that both directions compute the same bits.
bool in_order(const geo::Geodetic& a, const geo::Geodetic& b) {
  return std::tie(a.lat_deg, a.lon_deg, a.h_m) <= std::tie(b.lat_deg, b.lon_deg, b.h_m);
}

SightPlace place_of(const RayPoint& point) { return {point.place, point.clearance}; }

}  // namespace

Sight sight(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b,
            const SightSettings& settings) {
  const bool forward = in_order(a, b);
  Ray ray(surface, forward ? a : b, forward ? b : a, settings);
  const RayPoint lowest = ray.lowest();
  Sight result{ray.is_clear(lowest), ray.length(), place_of(lowest), std::nullopt};
  if (result.visible) return result;
  const auto first =
      forward ? ray.first_blocked(ray.begin(), ray.end()) : ray.first_blocked(ray.end(), ray.begin());
  result.blocked_at = place_of(first.value_or(lowest));
  return result;
}

double sight_ground(const Surface& surface, const geo::Geodetic& place, const SightSettings& settings) {
  const dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  LevelGround ground(surface, settings);
  return ground.of(ground.around(u)).height(u);
}

}  // namespace globe::planet
