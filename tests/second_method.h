#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/accuracy/study.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"
#include "globe/planet/grid.h"
#include "globe/planet/surface.h"

/// For tests that measure the errors of `globe accuracy` again, by second methods: what was reported, how the
/// second method's errors are summed up, and geometry in long double.
namespace second {

using app::accuracy::Setting;
using app::accuracy::Study;
using Long = long double;

using globe::geo::Geodetic;
using globe::htm::dvec3;

inline constexpr Long kLongDegree = std::numbers::pi_v<Long> / 180.0L;

inline const Setting& setting(const std::vector<Study>& studies, const std::string& study,
                              const std::string& name) {
  for (const Study& candidate : studies) {
    if (candidate.name != study) continue;
    for (const Setting& found : candidate.settings)
      if (found.name == name) return found;
  }
  throw std::out_of_range(study + ", " + name);
}

/// The largest and the root mean square of errors as the second method sees them.
class Second {
 public:
  void add(Long error, Long weight = 1.0L) {
    max_ = std::max(max_, std::abs(error));
    squares_ += weight * error * error;
    weights_ += weight;
  }
  Long max() const { return max_; }
  Long rms() const { return std::sqrt(squares_ / weights_); }

 private:
  Long max_ = 0, squares_ = 0, weights_ = 0;
};

inline void expect_agreement(const app::accuracy::ErrorFigure& reported, const Second& second,
                             const std::string& name) {
  EXPECT_NEAR(reported.max / static_cast<double>(second.max()), 1.0, 0.05) << name;
  EXPECT_NEAR(reported.rms / static_cast<double>(second.rms()), 1.0, 0.05) << name;
}
inline void expect_agreement(const Setting& reported, const Second& second) {
  expect_agreement(reported.error, second, reported.name);
}

using Vec = std::array<Long, 3>;

inline Long dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec to_long(const dvec3& u) { return {u.x, u.y, u.z}; }
inline Vec direction(const Geodetic& place) {
  const Long lat = Long(place.lat_deg) * kLongDegree, lon = Long(place.lon_deg) * kLongDegree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}
inline Geodetic place_of(const dvec3& u) {
  return {std::atan2(u.z, std::hypot(u.x, u.y)) * 180.0 / std::numbers::pi,
          std::atan2(u.y, u.x) * 180.0 / std::numbers::pi};
}

/// The angle at the centre, by Kahan's half angles.
inline Long angle(const Vec& a, const Vec& b) {
  Long apart = 0, together = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    apart += (a[k] - b[k]) * (a[k] - b[k]);
    together += (a[k] + b[k]) * (a[k] + b[k]);
  }
  return 2.0L * std::atan2(std::sqrt(apart), std::sqrt(together));
}

/// A trixel's corners and the share that each has in the point where the direction meets its plane.
struct Corners {
  std::array<Geodetic, 3> places;
  std::array<Long, 3> shares;
};

inline Corners corners_around(const dvec3& u, int level) {
  const globe::htm::Corners corners = globe::htm::corners(globe::htm::trixel_at(u, level));
  Corners result{};
  Long sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec next = to_long(corners[(k + 1) % 3]), last = to_long(corners[(k + 2) % 3]);
    result.places[k] = place_of(corners[k]);
    result.shares[k] = dot(to_long(u), cross(next, last));
    sum += result.shares[k];
  }
  for (Long& share : result.shares) share /= sum;
  return result;
}

inline Long spline(const std::array<Long, 4>& p, Long t) {
  // By the polynomials of Catmull and Rom's matrix; clamped as ours are.
  const Long s = 1.0L - t;
  const Long value = 0.5L * (-t * s * s * p[0] + (2.0L - 5.0L * t * t + 3.0L * t * t * t) * p[1] +
                             (t + 4.0L * t * t - 3.0L * t * t * t) * p[2] - t * t * s * p[3]);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  return std::clamp(value, *low, *high);
}

/// Height of a level's ground, from the corners of the trixel of HTM; the sea's floor where there is one.
inline Long ground(const globe::planet::Surface& surface, const dvec3& u, int level) {
  const Corners corners = corners_around(u, level);
  Long sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const globe::planet::Place at = globe::planet::locate(
        globe::geo::normal_from_degrees(corners.places[c].lat_deg, corners.places[c].lon_deg), level);
    const globe::planet::Node node{at.d, level, static_cast<int>(std::lround(at.ij.x)),
                                   static_cast<int>(std::lround(at.ij.y))};
    sum += corners.shares[c] * Long(surface.height(node));
  }
  return sum;
}

}  // namespace second
