#include "converters/block_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "converters/interpolate.h"

namespace converters {
namespace {

using globe::planet::dvec3;
using globe::planet::nodes_per_side;

constexpr std::int64_t kMaxWindowSamples = std::int64_t{1} << 21;

/// Moves a column by whole turns to within half a turn of a reference.
int near(const MapGeometry& geometry, int x, int reference) {
  if (geometry.period == 0) return x;
  if (x - reference > geometry.period / 2) return x - geometry.period;
  if (reference - x > geometry.period / 2) return x + geometry.period;
  return x;
}

}  // namespace

bool is_pole(int level, int i, int j) {
  const int n = nodes_per_side(level);
  return (i == 0 && j == 0) || (i == n && j == n);
}

BlockSampler::BlockSampler(const MapStack::Entry& entry, const NodeBlock& nodes, const BlockPart& part)
    : map_(*entry.map),
      geometry_(entry.map->geometry()),
      filter_(entry.filter),
      nodes_(nodes),
      part_(part),
      places_(part.size()) {
  const double reach = filter_ == Filter::kArea ? footprint_reach(nodes.level()) : 0.0;
  for (int j = part.j0; j < part.j0 + part.nj; ++j)
    find_places(geometry_, &nodes.at(part.i0, j), static_cast<std::size_t>(part.ni), reach,
                places_.data() + part.index(part.i0, j));
  const bool anywhere =
      std::any_of(places_.begin(), places_.end(), [](const SamplePlace& at) { return at.is_somewhere(); });
  if (filter_ == Filter::kArea && anywhere) find_footprints();
}

void BlockSampler::sample(float* values, float* weights) {
  std::fill_n(values, part_.size() * static_cast<std::size_t>(map_.channels()), 0.0F);
  std::fill_n(weights, part_.size(), 0.0F);
  sample(part_, values, weights);
  const int n = nodes_per_side(nodes_.level());
  for (const int at : {0, n}) {
    const bool here =
        at >= part_.i0 && at < part_.i0 + part_.ni && at >= part_.j0 && at < part_.j0 + part_.nj;
    if (here && is_round_pole(at, at)) sample_pole(at, at, values, weights);
  }
}

bool BlockSampler::holds(int i, int j) const { return is_on(geometry_, places_[part_.index(i, j)]); }

void BlockSampler::fill(int i, int j, float* out) const { map_.fill(places_[part_.index(i, j)], out); }

/// A pole that the map reaches all around: no place of the map is nearest to it.
bool BlockSampler::is_round_pole(int i, int j) const {
  if (!is_pole(nodes_.level(), i, j)) return false;
  return (i == 0 ? geometry_.north_shift : geometry_.south_shift) != MapGeometry::kNoPole;
}

/// The same in all four diamonds.
void BlockSampler::sample_pole(int i, int j, float* values, float* weights) const {
  const bool north = i == 0;
  float* out = values + part_.index(i, j) * static_cast<std::size_t>(map_.channels());
  weights[part_.index(i, j)] = static_cast<float>(
      filter_ == Filter::kArea ? cap_mean(map_, cap_rim(geometry_, nodes_.level(), north), north, out)
                               : row_mean(map_, north ? 0 : geometry_.height - 1, out));
}

/// Footprints of all nodes. Those on the diamond's border have other names and take the long way.
void BlockSampler::find_footprints() {
  find_centres();
  const int n = nodes_per_side(nodes_.level());
  footprints_.resize(places_.size());
  for (int j = part_.j0; j < part_.j0 + part_.nj; ++j) {
    for (int i = part_.i0; i < part_.i0 + part_.ni; ++i) {
      if (is_round_pole(i, j) || !places_[part_.index(i, j)].is_somewhere()) continue;
      const bool inside = i > 0 && j > 0 && i < n && j < n;
      footprints_[part_.index(i, j)] =
          inside ? inner_footprint(i, j) : footprint_of(geometry_, {nodes_.diamond(), nodes_.level(), i, j});
    }
  }
}

/// The places of the centres of the trixels around the part's nodes, as far as they lie in the diamond: cell
/// by cell the one with the cell's first node, then the other.
void BlockSampler::find_centres() {
  const int n = nodes_per_side(nodes_.level());
  const auto first = [](int at) { return std::max(0, at - 1); };
  const auto cells = [n, first](int at, int count) { return std::min(n, at + count) - first(at); };
  cells_ = {first(part_.i0), first(part_.j0), cells(part_.i0, part_.ni), cells(part_.j0, part_.nj)};
  const BlockPart corners{cells_.i0, cells_.j0, cells_.ni + 1, cells_.nj + 1};
  std::vector<dvec3> directions(corners.size());
  for (int j = corners.j0; j < corners.j0 + corners.nj; ++j) {
    for (int i = corners.i0; i < corners.i0 + corners.ni; ++i) {
      directions[corners.index(i, j)] =
          nodes_.holds(i, j) ? nodes_.at(i, j)
                             : globe::planet::node_direction({nodes_.diamond(), nodes_.level(), i, j});
    }
  }
  std::vector<dvec3> centres;
  centres.reserve(2 * cells_.size());
  for (int j = cells_.j0; j < cells_.j0 + cells_.nj; ++j) {
    for (int i = cells_.i0; i < cells_.i0 + cells_.ni; ++i) {
      const dvec3& a = directions[corners.index(i + 1, j)];
      const dvec3& b = directions[corners.index(i, j + 1)];
      centres.push_back(trixel_centre(geometry_, directions[corners.index(i, j)], a, b));
      centres.push_back(trixel_centre(geometry_, directions[corners.index(i + 1, j + 1)], b, a));
    }
  }
  centres_.resize(centres.size());
  find_places(geometry_, centres.data(), centres.size(), footprint_reach(nodes_.level()), centres_.data());
}

Footprint BlockSampler::inner_footprint(int i, int j) const {
  const auto first = [&](int ci, int cj) -> const SamplePlace& { return centres_[2 * cells_.index(ci, cj)]; };
  const auto second = [&](int ci, int cj) -> const SamplePlace& { return (&first(ci, cj))[1]; };
  return make_footprint(geometry_, places_[part_.index(i, j)],
                        {first(i, j), second(i - 1, j), first(i - 1, j), second(i - 1, j - 1),
                         first(i, j - 1), second(i, j - 1)},
                        6);
}

/// Splits the nodes until their window of the map is of a handy size.
void BlockSampler::sample(const BlockPart& part, float* values, float* weights) {
  const Bounds bounds = bounds_of(part);
  if (bounds.x1 < bounds.x0) return;
  const std::int64_t samples =
      (std::int64_t{bounds.x1} - bounds.x0 + 1) * (std::int64_t{bounds.y1} - bounds.y0 + 1);
  if (samples > kMaxWindowSamples && part.ni > 1 && part.ni >= part.nj) {
    sample({part.i0, part.j0, part.ni / 2, part.nj}, values, weights);
    sample({part.i0 + part.ni / 2, part.j0, part.ni - part.ni / 2, part.nj}, values, weights);
  } else if (samples > kMaxWindowSamples && part.nj > 1) {
    sample({part.i0, part.j0, part.ni, part.nj / 2}, values, weights);
    sample({part.i0, part.j0 + part.nj / 2, part.ni, part.nj - part.nj / 2}, values, weights);
  } else {
    window_.x0 = bounds.x0;
    window_.y0 = bounds.y0;
    window_.width = bounds.x1 - bounds.x0 + 1;
    window_.height = bounds.y1 - bounds.y0 + 1;
    map_.read(window_);
    sample_window(part, values, weights);
  }
}

void BlockSampler::sample_window(const BlockPart& part, float* values, float* weights) {
  const int reference = reference_column(part);
  for (int j = part.j0; j < part.j0 + part.nj; ++j) {
    for (int i = part.i0; i < part.i0 + part.ni; ++i) {
      const std::size_t k = part_.index(i, j);
      const SamplePlace& place = places_[k];
      const int x = near(geometry_, place.x.whole, reference);
      const Bounds reach = reach_of(i, j, x);
      if (reach.x1 < reach.x0) continue;
      weights[k] = static_cast<float>(value_at(i, j, {{x, place.x.fraction}, place.y},
                                               values + k * static_cast<std::size_t>(map_.channels())));
    }
  }
}

int BlockSampler::reference_column(const BlockPart& part) const {
  const bool skip = is_round_pole(part.i0, part.j0);
  const std::size_t first = part_.index(part.i0, part.j0);
  return places_[skip ? std::min(first + 1, places_.size() - 1) : first].x.whole;
}

/// Samples that a node takes, when it is counted at column x.
BlockSampler::Bounds BlockSampler::reach_of(int i, int j, int x) const {
  constexpr Bounds kNone{0, 0, -1, -1};
  const SamplePlace& place = places_[part_.index(i, j)];
  if (is_round_pole(i, j) || !place.is_somewhere()) return kNone;
  Bounds reach{x - 1, place.y.whole - 1, x + 2, place.y.whole + 2};
  // Off the map there is one more column or row, of no weight; beyond that nothing is asked for.
  const bool area = filter_ == Filter::kArea && footprints_[part_.index(i, j)].count > 0;
  if (area) {
    const Footprint& footprint = footprints_[part_.index(i, j)];
    const auto column = [&](double of) {  // whole numbers far off the map would not fit
      return x + static_cast<int>(std::floor(std::clamp(of, -1e9, 1e9)));
    };
    reach = {column(footprint.min_x()), static_cast<int>(std::floor(footprint.min_y())) - 1,
             column(footprint.max_x()) + 1, static_cast<int>(std::floor(footprint.max_y())) + 2};
    // What is averaged reaches half a sample beyond the outermost rows, no further.
    reach.y0 = std::max(reach.y0, -1);
    reach.y1 = std::min(reach.y1, geometry_.height);
    if (geometry_.period == 0) {
      reach.x0 = std::max(reach.x0, -1);
      reach.x1 = std::min(reach.x1, geometry_.width);
    }
    return reach.x1 < reach.x0 || reach.y1 < reach.y0 ? kNone : reach;
  }
  const bool beside = (geometry_.period == 0 && (reach.x1 < 0 || reach.x0 >= geometry_.width)) ||
                      (reach.y1 < 0 && geometry_.north_shift == MapGeometry::kNoPole) ||
                      (reach.y0 >= geometry_.height && geometry_.south_shift == MapGeometry::kNoPole);
  return beside ? kNone : reach;
}

BlockSampler::Bounds BlockSampler::bounds_of(const BlockPart& part) const {
  Bounds bounds{0, 0, -1, -1};
  const int reference = reference_column(part);
  for (int j = part.j0; j < part.j0 + part.nj; ++j) {
    for (int i = part.i0; i < part.i0 + part.ni; ++i) {
      const int x = near(geometry_, places_[part_.index(i, j)].x.whole, reference);
      const Bounds own = reach_of(i, j, x);
      if (own.x1 < own.x0) continue;
      bounds = bounds.x1 < bounds.x0 ? own
                                     : Bounds{std::min(bounds.x0, own.x0), std::min(bounds.y0, own.y0),
                                              std::max(bounds.x1, own.x1), std::max(bounds.y1, own.y1)};
    }
  }
  return bounds;
}

double BlockSampler::value_at(int i, int j, const SamplePlace& place, float* out) const {
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
  return footprint_mean(window_, map_.channels(), geometry_, footprints_[part_.index(i, j)], place, out);
}

}  // namespace converters
