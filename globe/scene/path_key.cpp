#include "globe/scene/path_key.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"
#include "globe/base/error.h"

namespace globe::scene {
namespace {

constexpr double kFarthest_m = 1e10;
constexpr double kSteep = 1e-7;  ///< radians from straight down

[[noreturn]] void refuse(const std::string& file, int line, const std::string& why,
                         const std::string& what_to_do) {
  throw Error(file + ":" + std::to_string(line), why, what_to_do);
}

/// Where the camera of a key stands, and its look there.
PathStop standing(const PathKey& key, const geo::Ellipsoid& ellipsoid,
                  const std::function<double(const geo::Geodetic&)>& ground_m, double least_m) {
  geo::Geodetic place = key.place;
  PathStop stop;
  stop.look = key.look;
  stop.stop = key.stop;
  stop.roll_deg = key.roll_deg;
  stop.jump = key.jump;
  if (key.above_ground) place.h_m += ground_m(place);
  if (key.range_m > 0.0) {
    const geo::LocalFrame there = geo::local_frame(place.lat_deg, place.lon_deg);
    const glm::dvec3 forward = geo::look_direction(there, key.look->heading_deg, key.look->pitch_deg);
    place =
        geo::geodetic_from_ecef(ellipsoid, geo::ecef_from_geodetic(ellipsoid, place) - forward * key.range_m);
    const geo::LocalFrame here = geo::local_frame(place.lat_deg, place.lon_deg);
    const double pitch = std::asin(std::clamp(glm::dot(forward, here.up), -1.0, 1.0)) * kRadian;
    // Straight down the heading is what points up in the picture.
    const bool steep = glm::length(glm::cross(forward, here.up)) < kSteep;
    const glm::dvec3 ahead =
        steep ? geo::look_direction(there, key.look->heading_deg, key.look->pitch_deg + 90.0) : forward;
    stop.look = Look{std::atan2(glm::dot(ahead, here.east), glm::dot(ahead, here.north)) * kRadian, pitch};
  }
  stop.u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  stop.ground_m = ground_m(place);
  stop.above_m = std::max(place.h_m - stop.ground_m, least_m);
  return stop;
}

}  // namespace

void require_path(const std::vector<PathKey>& keys, const std::string& file) {
  if (keys.size() < 2) {
    refuse(file, keys.empty() ? 1 : keys.front().line,
           keys.empty() ? "there is no place in it for a path" : "a path of one place leads nowhere",
           "give two or more");
  }
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const PathKey& key = keys[k];
    if (!(std::abs(key.place.lat_deg) <= 90.0) || !std::isfinite(key.place.lon_deg))
      refuse(file, key.line, "latitude or longitude is out of range", "write degrees, latitude in [-90, 90]");
    if (!(std::abs(key.place.h_m) <= kFarthest_m) || !(key.range_m >= 0.0 && key.range_m <= kFarthest_m))
      refuse(file, key.line, "the altitude is out of range", "write metres, at most 1e10");
    if (key.time_s.has_value() != keys.front().time_s.has_value())
      refuse(file, key.line, "some places have a time and some have none", "give a time to all or to none");
    if (!key.time_s) continue;
    if (!std::isfinite(*key.time_s)) refuse(file, key.line, "the time is not finite", "write seconds");
    if (k > 0 && !(*key.time_s > *keys[k - 1].time_s) && !(key.jump && key.time_s == keys[k - 1].time_s))
      refuse(file, key.line, "the time is not later than that of the place before",
             "put the places in the order of their times");
  }
  if (keys.front().time_s && !(*keys.back().time_s > *keys.front().time_s))
    refuse(file, keys.back().line, "the path takes no time", "let the camera fly or wait somewhere");
}

std::vector<PathStop> stops_of(const std::vector<PathKey>& keys, const geo::Ellipsoid& ellipsoid,
                               const std::function<double(const geo::Geodetic&)>& ground_m, double least_m) {
  std::vector<PathStop> stops;
  double gone_m = 0.0;
  for (const PathKey& key : keys) {
    PathStop stop = standing(key, ellipsoid, ground_m, least_m);
    if (key.time_s) {
      stop.time_s = *key.time_s - *keys.front().time_s;
      if (stop.jump && !stops.empty() && stops.back().time_s < stop.time_s) {
        PathStop& held = stops.emplace_back(stops.back());
        held.time_s = stop.time_s;
        held.jump = false;
      }
    } else if (!stops.empty()) {
      const PathStop& before = stops.back();
      const double step_m =
          glm::distance(geo::ecef_from_normal(ellipsoid, before.u, before.ground_m + before.above_m),
                        geo::ecef_from_normal(ellipsoid, stop.u, stop.ground_m + stop.above_m));
      if (step_m < 1e-9 * ellipsoid.a) continue;
      gone_m += step_m;
      stop.time_s = gone_m;
    }
    stops.push_back(stop);
  }
  if (stops.size() < 2) throw Error("path", "all its places are one", "give places that lie apart");
  if (!keys.front().time_s) {
    for (PathStop& stop : stops) stop.time_s *= kUntimed / gone_m;
  }
  return stops;
}

}  // namespace globe::scene
