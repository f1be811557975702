#pragma once

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>

#include "tests/bench/search/points.h"

namespace bench {

/// Geodesic distances on WGS84 from one place, and what lies beyond them for certain.
class Ruler {
 public:
  explicit Ruler(const Point& near)
      : near_(near), u_(globe::geo::normal_from_degrees(near.lat_deg, near.lon_deg)) {}

  double distance_m(const Point& to) const {
    double result = 0;
    GeographicLib::Geodesic::WGS84().Inverse(near_.lat_deg, near_.lon_deg, to.lat_deg, to.lon_deg, result);
    return result;
  }

  /// The angle between normals (radians) beyond which everything is farther than the distance.
  static double angle_of(double distance_m) {
    const double b = globe::geo::kWgs84.b();
    const double shortest_scale_m = b * (b / globe::geo::kWgs84.a);  // the smallest radius of curvature
    return std::min(distance_m / shortest_scale_m * (1.0 + 1e-9) + 1e-12, M_PI);
  }

  /// Cosine of the angle between the normals of both.
  double cosine(const Point& to) const {
    const globe::geo::dvec3 v = globe::geo::normal_from_degrees(to.lat_deg, to.lon_deg);
    return u_.x * v.x + u_.y * v.y + u_.z * v.z;
  }

 private:
  Point near_;
  globe::geo::dvec3 u_;
};

/// The `count` nearest of those added.
class NearestList {
 public:
  explicit NearestList(std::size_t count) : count_(count) {}

  void add(double distance_m, std::int64_t id) {
    answer_.emplace_back(distance_m, id);
    std::push_heap(answer_.begin(), answer_.end());
    if (answer_.size() > count_) {
      std::pop_heap(answer_.begin(), answer_.end());
      answer_.pop_back();
    }
  }
  bool full() const { return answer_.size() == count_; }
  double worst_m() const { return answer_.front().first; }
  Answer sorted() {
    std::sort_heap(answer_.begin(), answer_.end());
    return answer_;
  }

 private:
  std::size_t count_;
  Answer answer_;
};

}  // namespace bench
