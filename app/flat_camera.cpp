#include "app/flat_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "globe/base/angles.h"

namespace app {
namespace {

using globe::kDegree;

namespace flat = globe::flat;
namespace geo = globe::geo;
using glm::dvec3;

constexpr int kPathSamples = 1024;
constexpr int kReach = kPathSamples / 12;  ///< of a rise, to each side of what it is for
constexpr double kKept = 0.25;             ///< of the height above ground
constexpr double kLeast = 2.0;             ///< metres above ground

double ground_z(const flat::Terrain& terrain, const dvec3& at) { return terrain.z_at(at.x, at.y); }

}  // namespace

FlatView overview(const flat::Terrain& terrain) {
  const flat::PostRect& posts = terrain.posts();
  const double x = 0.5 * (terrain.x_m(0) + terrain.x_m(posts.columns - 1));
  const double south = terrain.y_m(0);
  const double length = terrain.y_m(posts.rows - 1) - south;
  double highest = -1e30;
  for (std::size_t k = 0; k < terrain.patch_count(); ++k)
    highest = std::max(highest, static_cast<double>(terrain.patch(k).highest_m));
  const double y = south - 0.1 * length;
  const double z = highest + 0.22 * length;
  const double middle = ground_z(terrain, {x, south + 0.5 * length, 0.0});
  return {terrain.frame().geodetic_from_local({x, y, z}),
          {0.0, std::atan2(middle - z, 0.6 * length) / kDegree}};
}

FlatFlight::FlatFlight(const flat::Terrain& terrain, const FlatView& from, const FlatView& to)
    : terrain_(terrain),
      from_(from),
      to_(to),
      begin_(terrain.frame().local_from_geodetic(from.place)),
      end_(terrain.frame().local_from_geodetic(to.place)),
      raised_m_(kPathSamples + 1) {
  std::vector<double> missing(raised_m_.size());
  const double from_above = begin_.z - ground_z(terrain, begin_);
  const double to_above = end_.z - ground_z(terrain, end_);
  for (int k = 0; k <= kPathSamples; ++k) {
    const double t = static_cast<double>(k) / kPathSamples;
    const dvec3 at = glm::mix(begin_, end_, t);
    const double keep = std::max(kKept * (from_above + (to_above - from_above) * t), kLeast);
    missing[static_cast<std::size_t>(k)] = std::max(ground_z(terrain, at) + keep - at.z, 0.0);
  }
  // The highest within reach, then the mean of that within reach: smooth, and nowhere too low.
  const auto within_reach = [&](const std::vector<double>& of, int k, const auto& take) {
    for (int n = std::max(k - kReach, 0); n <= std::min(k + kReach, kPathSamples); ++n)
      take(of[static_cast<std::size_t>(n)]);
  };
  std::vector<double> highest(missing.size(), 0.0);
  for (int k = 0; k <= kPathSamples; ++k) {
    double& most = highest[static_cast<std::size_t>(k)];
    within_reach(missing, k, [&](double m) { most = std::max(most, m); });
  }
  for (int k = 0; k <= kPathSamples; ++k) {
    double sum = 0.0;
    int count = 0;
    within_reach(highest, k, [&](double m) {
      sum += m;
      ++count;
    });
    raised_m_[static_cast<std::size_t>(k)] = sum / count;
  }
}

FlatView FlatFlight::at(double t) const {
  const double eased = t * t * (3.0 - 2.0 * t);
  const double sample = eased * kPathSamples;
  const auto k = std::min(static_cast<std::size_t>(sample), raised_m_.size() - 2);
  const double share = sample - static_cast<double>(k);
  dvec3 at = glm::mix(begin_, end_, eased);
  at.z += raised_m_[k] + (raised_m_[k + 1] - raised_m_[k]) * share;
  const double turn = std::remainder(to_.look.heading_deg - from_.look.heading_deg, 360.0);
  return {terrain_.frame().geodetic_from_local(at),
          {from_.look.heading_deg + turn * eased,
           from_.look.pitch_deg + (to_.look.pitch_deg - from_.look.pitch_deg) * eased}};
}

}  // namespace app
