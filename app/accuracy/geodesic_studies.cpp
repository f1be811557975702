#include <GeographicLib/GeodesicExact.hpp>
#include <algorithm>
#include <cstdio>
#include <numbers>

#include "app/accuracy/samples.h"
#include "app/accuracy/vincenty.h"
#include "globe/base/angles.h"
#include "globe/geo/geodesic.h"

namespace app::accuracy {
namespace {

using globe::kDegree;
using globe::geo::Geodetic;
using globe::geo::kWgs84;

std::string place_text(const PlacePair& pair) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6f,%.6f to %.6f,%.6f", pair.a.lat_deg, pair.a.lon_deg, pair.b.lat_deg,
                pair.b.lon_deg);
  return text;
}

constexpr const char* kPairs =
    " pairs: anywhere, within a kilometre, within 0.3 degrees of the opposite place, along the equator and "
    "meridians";

/// Time of `distance` over all pairs, a pair.
template <typename Distance>
std::function<double()> time_a_pair(const std::vector<PlacePair>& pairs, Distance distance) {
  return timed(static_cast<double>(pairs.size()), [=] {
    double sum = 0;
    for (const PlacePair& pair : pairs) sum += distance(pair);
    keep(sum);
  });
}

double haversine(const PlacePair& pair, double radius) {
  const double dlat = (pair.b.lat_deg - pair.a.lat_deg) * kDegree,
               dlon = (pair.b.lon_deg - pair.a.lon_deg) * kDegree;
  const double y = std::sin(dlat / 2.0), x = std::sin(dlon / 2.0);
  const double h = y * y + std::cos(pair.a.lat_deg * kDegree) * std::cos(pair.b.lat_deg * kDegree) * x * x;
  return 2.0 * radius * std::asin(std::sqrt(std::min(h, 1.0)));
}

double arc_cosine(const PlacePair& pair, double radius) {
  const double a = pair.a.lat_deg * kDegree, b = pair.b.lat_deg * kDegree;
  const double c = std::sin(a) * std::sin(b) +
                   std::cos(a) * std::cos(b) * std::cos((pair.b.lon_deg - pair.a.lon_deg) * kDegree);
  return radius * std::acos(std::clamp(c, -1.0, 1.0));
}

/// In long double, by the arc tangent, which is sharp at every separation.
long double sphere_truth(const PlacePair& pair, double radius) {
  using Long = long double;
  constexpr Long kLongDegree = std::numbers::pi_v<Long> / 180.0L;
  const Long a = Long(pair.a.lat_deg) * kLongDegree, b = Long(pair.b.lat_deg) * kLongDegree;
  const Long l = (Long(pair.b.lon_deg) - Long(pair.a.lon_deg)) * kLongDegree;
  const Long x = std::cos(b) * std::sin(l);
  const Long y = std::cos(a) * std::sin(b) - std::sin(a) * std::cos(b) * std::cos(l);
  const Long z = std::sin(a) * std::sin(b) + std::cos(a) * std::cos(b) * std::cos(l);
  return Long(radius) * std::atan2(std::sqrt(x * x + y * y), z);
}

Study on_the_ellipsoid(const std::vector<PlacePair>& pairs) {
  const GeographicLib::GeodesicExact exact(kWgs84.a, kWgs84.f);
  std::vector<double> truth;
  for (const PlacePair& pair : pairs) {
    double s12 = 0;
    exact.Inverse(pair.a.lat_deg, pair.a.lon_deg, pair.b.lat_deg, pair.b.lon_deg, s12);
    truth.push_back(s12);
  }
  Study study{"geodesics.ellipsoid",
              "Distance on the ellipsoid",
              "",
              "GeographicLib's GeodesicExact (elliptic integrals)",
              std::to_string(pairs.size()) + kPairs,
              "m",
              "ns a pair",
              {}};
  const auto add = [&](const char* name, auto distance, bool is_default) {
    ErrorSum sum;
    std::size_t unsettled = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::optional<double> found = distance(pairs[k]);
      unsettled += found ? 0 : 1;
      if (found) sum.add(*found - truth[k], [&] { return place_text(pairs[k]); });
    }
    std::string note;
    if (unsettled > 0)
      note = "no answer to " + std::to_string(unsettled) + " of " + std::to_string(pairs.size()) + " pairs";
    const auto cost = time_a_pair(pairs, [distance](const PlacePair& pair) {
      const std::optional<double> found = distance(pair);
      return found.value_or(0.0);
    });
    study.settings.push_back({name, sum.figure(), cost, is_default, note});
  };
  const double radius = kWgs84.mean_radius();
  add(
      "great circle", [radius](const PlacePair& pair) { return std::optional(haversine(pair, radius)); },
      false);
  add(
      "Vincenty", [](const PlacePair& pair) { return vincenty(kWgs84, pair.a, pair.b); }, false);
  const globe::geo::GeodesicSolver karney(kWgs84);
  add(
      "Karney",
      [karney](const PlacePair& pair) { return std::optional(karney.inverse(pair.a, pair.b).s12_m); }, true);
  return study;
}

Study on_the_sphere(const std::vector<PlacePair>& pairs) {
  const double radius = kWgs84.mean_radius();
  Study study{"geodesics.sphere",
              "Distance on a sphere of the Earth's size",
              "",
              "arc tangent in long double",
              std::to_string(pairs.size()) + kPairs,
              "m",
              "ns a pair",
              {}};
  const auto add = [&](const char* name, auto distance, bool is_default) {
    ErrorSum sum;
    for (const PlacePair& pair : pairs)
      sum.add(static_cast<double>(distance(pair) - sphere_truth(pair, radius)),
              [&] { return place_text(pair); });
    study.settings.push_back({name, sum.figure(), time_a_pair(pairs, distance), is_default});
  };
  add(
      "arc cosine", [radius](const PlacePair& pair) { return arc_cosine(pair, radius); }, false);
  add(
      "haversine", [radius](const PlacePair& pair) { return haversine(pair, radius); }, false);
  const globe::geo::GeodesicSolver solver(globe::geo::Ellipsoid{radius, 0.0});
  add(
      "Karney, f = 0", [solver](const PlacePair& pair) { return solver.inverse(pair.a, pair.b).s12_m; },
      true);
  return study;
}

/// Where a latitude and longitude lie in space.
Study shape(const std::vector<PlacePair>& pairs) {
  Study study{"geodesics.shape",
              "Place in space: ellipsoid or sphere",
              "--ellipsoid",
              "closed form on WGS84 in long double",
              std::to_string(pairs.size()) + " places of those pairs, the poles and the equator among them",
              "m",
              "ns a place",
              {}};
  const auto truth = [](const Geodetic& place) {
    using Long = long double;
    constexpr Long kLongDegree = std::numbers::pi_v<Long> / 180.0L;
    const Long lat = Long(place.lat_deg) * kLongDegree, lon = Long(place.lon_deg) * kLongDegree;
    const Long a = kWgs84.a, f = kWgs84.f, e2 = f * (2.0L - f);
    const Long n = a / std::sqrt(1.0L - e2 * std::sin(lat) * std::sin(lat));
    return std::array<Long, 3>{n * std::cos(lat) * std::cos(lon), n * std::cos(lat) * std::sin(lon),
                               n * (1.0L - e2) * std::sin(lat)};
  };
  const auto add = [&](const char* name, const globe::geo::Ellipsoid& body, bool is_default) {
    ErrorSum sum;
    const auto look = [&](const Geodetic& place) {
      const auto [x, y, z] = truth(place);
      const globe::geo::dvec3 p = globe::geo::ecef_from_geodetic(body, place);
      const double off = static_cast<double>(std::hypot(std::hypot(p.x - x, p.y - y), p.z - z));
      sum.add(off, [&] {
        return place_text({place, place}).substr(0, place_text({place, place}).find(" to "));
      });
    };
    for (const PlacePair& pair : pairs) look(pair.a);
    for (const double lat : {-90.0, 0.0, 90.0}) look({lat, 45.0});
    const auto cost = timed(static_cast<double>(pairs.size()), [=] {
      double all = 0;
      for (const PlacePair& pair : pairs) all += globe::geo::ecef_from_geodetic(body, pair.a).x;
      keep(static_cast<double>(all));
    });
    study.settings.push_back({name, sum.figure(), cost, is_default});
  };
  add("sphere", {kWgs84.mean_radius(), 0.0}, false);
  add("ellipsoid", kWgs84, true);
  return study;
}

}  // namespace

std::vector<Study> geodesic_studies(const Scope& scope) {
  const std::vector<PlacePair> pairs = geodesic_pairs(scope);
  return {on_the_ellipsoid(pairs), on_the_sphere(pairs), shape(pairs)};
}

}  // namespace app::accuracy
