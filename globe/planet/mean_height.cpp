#include "globe/planet/mean_height.h"

#include <algorithm>
#include <cassert>

#include "globe/geo/area.h"

namespace globe::planet {
namespace {

/// The level whose trixels are weighted by their true areas.
constexpr int kWeighted = 8;
int weighted_level(int height_level) { return std::max(std::min(height_level, kWeighted), height_level - 2); }

/// The mean over the heights' trixels in t, taken as equal: a node counts once for each that it is a corner
/// of, 1 at the corners, 3 on the sides, 6 inside.
double plain_mean(const HeightBlock& heights, const LatticeTrixel& t) {
  const int m = 1 << (heights.height_level - t.level);
  double sum = 0;
  for (int b = 0; b <= m; ++b) {
    for (int a = 0; a + b <= m; ++a) {
      const int sides = (a == 0) + (b == 0) + (a + b == m);
      const double trixels = sides == 0 ? 6.0 : sides == 1 ? 3.0 : 1.0;
      sum += trixels * heights.at(m * t.i + t.sign * a, m * t.j + t.sign * b);
    }
  }
  return sum / (3.0 * m * m);
}

}  // namespace

double mean_of_children(const geo::Ellipsoid& ellipsoid, const htm::Corners& corners,
                        const std::array<double, 4>& means, double tolerance) {
  const auto parts = children_corners(corners);
  double area = 0, sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double part = geo::surface_area(ellipsoid, parts[k], tolerance);
    area += part;
    sum += part * means[k];
  }
  return sum / area;
}

double mean_height(const geo::Ellipsoid& ellipsoid, const HeightBlock& heights, const LatticeTrixel& t,
                   const htm::Corners& corners) {
  assert(t.level >= block_level(heights.height_level) && t.level <= heights.height_level);
  if (t.level >= weighted_level(heights.height_level)) return plain_mean(heights, t);
  const auto parts = children(t);
  const auto part_corners = children_corners(corners);
  std::array<double, 4> means{};
  for (std::size_t k = 0; k < 4; ++k) means[k] = mean_height(ellipsoid, heights, parts[k], part_corners[k]);
  constexpr double kExact = 1e-8, kFine = 2e-5;
  return mean_of_children(ellipsoid, corners, means, t.level < kWeighted ? kExact : kFine);
}

}  // namespace globe::planet
