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

double above_ground(const flat::Terrain& terrain, const geo::Geodetic& place) {
  return std::max(terrain.height_above(geo::ecef_from_geodetic(terrain.frame().ellipsoid(), place)), kLeast);
}

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
      from_above_m_(above_ground(terrain, from.place)),
      to_above_m_(above_ground(terrain, to.place)),
      from_ground_m_(from.place.h_m - from_above_m_),
      to_ground_m_(to.place.h_m - to_above_m_),
      path_(geo::normal_from_degrees(from.place.lat_deg, from.place.lon_deg), from_above_m_,
            geo::normal_from_degrees(to.place.lat_deg, to.place.lon_deg), to_above_m_,
            terrain.frame().ellipsoid().mean_radius(), 0.0, 0.0),
      raised_m_(kPathSamples + 1) {
  std::vector<double> missing(raised_m_.size());
  for (int k = 0; k <= kPathSamples; ++k) {
    const Planned plan = planned(static_cast<double>(k) / kPathSamples);
    const double keep = std::max(kKept * plan.above_m, kLeast);
    missing[static_cast<std::size_t>(k)] = std::max(ground_z(terrain, plan.at) + keep - plan.at.z, 0.0);
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

FlatFlight::Planned FlatFlight::planned(double t) const {
  const globe::scene::PathPoint point = path_.at(t);
  const double eased = globe::scene::FlightPath::eased(t);
  geo::Geodetic place = geo::degrees_from_normal(point.u);
  place.h_m = point.height_m + glm::mix(from_ground_m_, to_ground_m_, eased);
  // From one end's look to the other's, but down where the way leads higher than from one end's height to the
  // other's.
  const double level_m = from_above_m_ * std::pow(to_above_m_ / from_above_m_, eased);
  const double pitch_deg = glm::mix(from_.look.pitch_deg, to_.look.pitch_deg, eased);
  return {terrain_.frame().local_from_geodetic(place), point.height_m,
          globe::scene::pitch_for_height(std::max(point.height_m, level_m), level_m, pitch_deg)};
}

FlatView FlatFlight::at(double t) const {
  const double sample = t * kPathSamples;
  const auto k = std::min(static_cast<std::size_t>(sample), raised_m_.size() - 2);
  const double share = sample - static_cast<double>(k);
  const double eased = globe::scene::FlightPath::eased(t);
  Planned plan = planned(t);
  plan.at.z += glm::mix(raised_m_[k], raised_m_[k + 1], share);
  plan.at.z = std::max(plan.at.z, ground_z(terrain_, plan.at) + kLeast);
  const double turn = std::remainder(to_.look.heading_deg - from_.look.heading_deg, 360.0);
  return {terrain_.frame().geodetic_from_local(plan.at),
          {from_.look.heading_deg + turn * eased, plan.pitch_deg,
           glm::mix(from_.look.roll_deg, to_.look.roll_deg, eased)}};
}

}  // namespace app
