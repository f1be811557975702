#include "converters/inset_footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "converters/inset_grid.h"
#include "globe/base/angles.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::dvec3;
using globe::planet::InsetBlock;
using globe::planet::node_direction;

constexpr int kTile = InsetGrid<float>::kTile;
constexpr double kLongestEdge = 2.5;  ///< radians, times 2^-level: more than any edge of the lattice

/// A cap around a direction, radians.
struct Cap {
  dvec3 middle;
  double radius;
};

/// Whether an equirectangular map of a part of the planet may reach into a cap.
bool reaches(const MapGeometry& map, const Cap& cap) {
  if (map.is_whole_planet()) return true;
  const double lat = std::asin(std::clamp(cap.middle.z, -1.0, 1.0)) / kDegree;
  const double radius = cap.radius / kDegree + 0.2;  // geocentric rows differ so much from geodetic ones
  const double north = map.north_deg + map.row_step_deg;
  const double south = map.north_deg - map.height * map.row_step_deg;
  if (lat - radius > north || lat + radius < south) return false;
  if (map.period > 0 || std::abs(lat) + radius >= 90.0) return true;
  const double aside =
      std::asin(std::min(1.0, std::sin(radius * kDegree) / std::cos(lat * kDegree))) / kDegree;
  const double half = 0.5 * (map.width + 1) * map.step_deg;
  const double middle = map.west_deg + 0.5 * (map.width - 1) * map.step_deg;
  const double lon = std::atan2(cap.middle.y, cap.middle.x) / kDegree;
  return std::abs(std::remainder(lon - middle, 360.0)) <= half + aside;
}

bool may_reach(const MapGeometry& map, const Cap& cap) {
  if (!map.projection) return reaches(map, cap);
  SamplePlace place;
  find_places(map, &cap.middle, 1, cap.radius, &place);
  return place.is_somewhere();
}

class Search {
 public:
  Search(const std::vector<MapGeometry>& maps, int level, int margin)
      : maps_(maps),
        level_(level),
        n_(globe::planet::nodes_per_side(level)),
        beside_(margin * kLongestEdge / n_) {}

  std::vector<InsetBlock> run() {
    const int first = std::max(kTile, n_ / 64);
    for (int d = 0; d < globe::planet::kDiamonds; ++d) {
      for (int j = 0; j < n_; j += first)
        for (int i = 0; i < n_; i += first) descend(d, i, j, first);
    }
    return std::move(found_);
  }

 private:
  void descend(int d, int i, int j, int size) {
    const auto at = [&](int x, int y) { return node_direction({d, level_, x, y}); };
    Cap cap{at(i + size / 2, j + size / 2), 0.0};
    for (const dvec3& corner : {at(i, j), at(i + size, j), at(i, j + size), at(i + size, j + size)})
      cap.radius = std::max(cap.radius, 2.0 * std::asin(0.5 * glm::distance(corner, cap.middle)));
    cap.radius = 1.1 * cap.radius + beside_;
    if (std::none_of(maps_.begin(), maps_.end(), [&](const MapGeometry& map) { return may_reach(map, cap); }))
      return;
    if (size == kTile) {
      found_.push_back({d, i, i + kTile == n_ ? n_ : i + kTile - 1, j, j + kTile == n_ ? n_ : j + kTile - 1});
      return;
    }
    const int half = size / 2;
    for (const auto& [x, y] : {std::pair{i, j}, {i + half, j}, {i, j + half}, {i + half, j + half}})
      descend(d, x, y, half);
  }

  const std::vector<MapGeometry>& maps_;
  int level_, n_;
  double beside_;  ///< radians
  std::vector<InsetBlock> found_;
};

}  // namespace

std::vector<InsetBlock> footprint_blocks(const std::vector<MapGeometry>& maps, int level, int margin) {
  return Search(maps, level, margin).run();
}

std::vector<InsetBlock> bounds_of(const std::vector<InsetBlock>& blocks) {
  std::vector<InsetBlock> bounds;
  for (const InsetBlock& block : blocks) {
    if (bounds.empty() || bounds.back().d != block.d) bounds.push_back(block);
    InsetBlock& all = bounds.back();
    all = {block.d, std::min(all.i0, block.i0), std::max(all.i1, block.i1), std::min(all.j0, block.j0),
           std::max(all.j1, block.j1)};
  }
  return bounds;
}

}  // namespace converters
