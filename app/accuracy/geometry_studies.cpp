#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>

#include "app/accuracy/samples.h"
#include "globe/base/angles.h"
#include "globe/geo/arctangent.h"
#include "globe/geo/area.h"
#include "globe/geo/ellipsoid.h"
#include "globe/geo/sine_cosine.h"
#include "globe/htm/trixel.h"

namespace app::accuracy {
namespace {

using globe::kDegree;
using globe::geo::Geodetic;
using globe::htm::dvec3;
using Long = long double;

constexpr Long kLongDegree = std::numbers::pi_v<Long> / 180.0L;

std::string text_of(const Geodetic& place) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6f,%.6f", place.lat_deg, place.lon_deg);
  return text;
}

double distance(const std::array<Long, 3>& truth, const dvec3& found, double radius_m) {
  return static_cast<double>(
      std::hypot(std::hypot(truth[0] - found.x, truth[1] - found.y), truth[2] - found.z) * radius_m);
}

using Places = std::shared_ptr<const std::vector<Geodetic>>;

dvec3 library_normal(const Geodetic& place) {
  const double lat = place.lat_deg * kDegree, lon = place.lon_deg * kDegree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

dvec3 float_normal(const Geodetic& place) {
  constexpr float kFloatDegree = std::numbers::pi_v<float> / 180.0F;
  const float lat = static_cast<float>(place.lat_deg) * kFloatDegree,
              lon = static_cast<float>(place.lon_deg) * kFloatDegree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

Study normals(const Places& places, double radius_m) {
  Study study{"geometry.sine_cosine",
              "A place's direction from its degrees",
              "",
              "sine and cosine in long double",
              std::to_string(places->size()) +
                  " places: anywhere, on edges of diamonds, on the equator, at the poles",
              "m on the Earth",
              "ns a place",
              {}};
  const auto add = [&](const char* name, auto normal, bool is_default) {
    ErrorSum sum;
    for (const Geodetic& place : *places) {
      const Long lat = Long(place.lat_deg) * kLongDegree, lon = Long(place.lon_deg) * kLongDegree;
      const std::array<Long, 3> truth{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon),
                                      std::sin(lat)};
      sum.add(distance(truth, normal(place), radius_m), [&] { return text_of(place); });
    }
    const auto cost = timed(static_cast<double>(places->size()), [places, normal] {
      double all = 0;
      for (const Geodetic& place : *places) all += normal(place).x;
      keep(all);
    });
    study.settings.push_back({name, sum.figure(), cost, is_default});
  };
  add("the C library's, float", float_normal, false);
  add("the C library's, double", library_normal, false);
  add(
      "our polynomials",
      [](const Geodetic& place) { return globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg); },
      true);
  study.settings.back().note = "the same bits on every machine";
  return study;
}

Study longitudes(const Places& places, double radius_m) {
  std::vector<dvec3> directions;
  for (const Geodetic& place : *places)
    directions.push_back(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg));
  const auto at = std::make_shared<const std::vector<dvec3>>(std::move(directions));
  Study study{"geometry.arctangent",
              "A direction's longitude in degrees",
              "",
              "arc tangent in long double",
              "the directions of those places",
              "m on the equator",
              "ns a place",
              {}};
  const auto add = [&](const char* name, auto angle_deg, bool is_default) {
    ErrorSum sum;
    for (std::size_t k = 0; k < at->size(); ++k) {
      const dvec3& u = (*at)[k];
      const Long truth = std::atan2(Long(u.y), Long(u.x)) / kLongDegree;
      sum.add(static_cast<double>((angle_deg(u.y, u.x) - truth) * kLongDegree * radius_m),
              [&] { return text_of((*places)[k]); });
    }
    const auto cost = timed(static_cast<double>(at->size()), [at, angle_deg] {
      double all = 0;
      for (const dvec3& u : *at) all += angle_deg(u.y, u.x);
      keep(all);
    });
    study.settings.push_back({name, sum.figure(), cost, is_default});
  };
  add(
      "the C library's, float",
      [](double y, double x) {
        return static_cast<double>(std::atan2(static_cast<float>(y), static_cast<float>(x)) * 180.0F /
                                   std::numbers::pi_v<float>);
      },
      false);
  add(
      "the C library's, double",
      [](double y, double x) { return std::atan2(y, x) * 180.0 / std::numbers::pi; }, false);
  add(
      "our rational function", [](double y, double x) { return globe::geo::arctangent(y, x); }, true);
  study.settings.back().note = "the same bits on every machine";
  return study;
}

/// Halving an edge again and again: how far a corner drifts from where the directions in between put it.
Study midpoints(const Scope& scope, double radius_m) {
  constexpr int kLevel = 20;
  std::mt19937_64 random(5);
  const std::size_t count = scope.full ? 4000 : 1000;
  std::vector<globe::htm::Trixel> trixels;
  for (std::size_t k = 0; k < count; ++k) {
    globe::htm::Trixel trixel{globe::htm::kFirstRoot + random() % globe::htm::kRoots};
    for (int level = 0; level < kLevel; ++level)
      trixel = globe::htm::child(trixel, static_cast<int>(random() % 4));
    trixels.push_back(trixel);
  }
  const auto truth_of = [](globe::htm::Trixel trixel) {
    using Corner = std::array<Long, 3>;
    const auto middle = [](const Corner& a, const Corner& b) {
      Corner sum{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
      const Long length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
      for (Long& x : sum) x /= length;
      return sum;
    };
    std::vector<int> path;
    globe::htm::Trixel root = trixel;
    while (globe::htm::level(root) > 0) {
      path.push_back(static_cast<int>(root.id & 3U));
      root = globe::htm::parent(root);
    }
    const globe::htm::Corners begin = globe::htm::corners(root);
    std::array<Corner, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {begin[k].x, begin[k].y, begin[k].z};
    for (auto step = path.rbegin(); step != path.rend(); ++step) {
      const Corner w0 = middle(corners[1], corners[2]), w1 = middle(corners[2], corners[0]),
                   w2 = middle(corners[0], corners[1]);
      switch (*step) {
        case 0:
          corners = {corners[0], w2, w1};
          break;
        case 1:
          corners = {corners[1], w0, w2};
          break;
        case 2:
          corners = {corners[2], w1, w0};
          break;
        default:
          corners = {w0, w1, w2};
      }
    }
    return corners;
  };
  const auto in_float = [](globe::htm::Trixel trixel) {
    const auto rounded = [](const dvec3& u) {
      return std::array<float, 3>{static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)};
    };
    std::array<dvec3, 3> result{};
    const globe::htm::Corners exact = globe::htm::corners(trixel);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto u = rounded(exact[k]);
      result[k] = {u[0], u[1], u[2]};
    }
    return result;
  };
  Study study{"geometry.midpoints",
              "Corners of trixels of level " + std::to_string(kLevel),
              "",
              "the same halvings in long double",
              std::to_string(count) + " trixels of level " + std::to_string(kLevel) + " at random",
              "m on the Earth",
              "ns a trixel",
              {}};
  const auto at = std::make_shared<const std::vector<globe::htm::Trixel>>(std::move(trixels));
  const auto add = [&](const char* name, auto corners_of, bool is_default) {
    ErrorSum sum;
    for (const globe::htm::Trixel trixel : *at) {
      const auto truth = truth_of(trixel);
      const auto found = corners_of(trixel);
      for (std::size_t k = 0; k < 3; ++k)
        sum.add(distance(truth[k], found[k], radius_m), [&] { return globe::htm::name(trixel); });
    }
    const auto cost = timed(static_cast<double>(at->size()), [at, corners_of] {
      double all = 0;
      for (const globe::htm::Trixel trixel : *at) all += corners_of(trixel)[0].x;
      keep(all);
    });
    study.settings.push_back({name, sum.figure(), cost, is_default});
  };
  add("stored as float", in_float, false);
  add(
      "double", [](globe::htm::Trixel trixel) { return globe::htm::corners(trixel); }, true);
  return study;
}

}  // namespace

std::vector<Study> geometry_studies(const Scope& scope) {
  const double radius_m = globe::geo::kWgs84.a;
  const auto places = std::make_shared<const std::vector<Geodetic>>(height_places(scope));
  return {normals(places, radius_m), longitudes(places, radius_m), midpoints(scope, radius_m)};
}

}  // namespace app::accuracy
