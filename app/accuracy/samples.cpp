#include "app/accuracy/samples.h"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <random>

#include "globe/base/angles.h"
#include "globe/planet/interpolation.h"

namespace app::accuracy {
namespace {

using globe::kDegree;
using globe::geo::Geodetic;

}  // namespace

std::vector<PlacePair> geodesic_pairs(const Scope& scope) {
  const std::size_t count = scope.full ? 2500 : 250;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto anywhere = [&] { return Geodetic{std::asin(unit(random)) / kDegree, 180.0 * unit(random)}; };
  std::vector<PlacePair> pairs;
  for (std::size_t k = 0; k < count; ++k) {
    const Geodetic a = anywhere();
    pairs.push_back({a, anywhere()});
    pairs.push_back(
        {a, {std::clamp(a.lat_deg + 0.005 * unit(random), -90.0, 90.0), a.lon_deg + 0.005 * unit(random)}});
    pairs.push_back({a,
                     {-a.lat_deg + 0.3 * unit(random) * (std::abs(a.lat_deg) < 89.0 ? 1.0 : 0.0),
                      a.lon_deg + 180.0 + 0.3 * unit(random)}});
    pairs.push_back(
        {{0.0, a.lon_deg}, {k % 2 == 0 ? 0.0 : 90.0 * unit(random), a.lon_deg + (k % 2 == 0 ? 170.0 : 0.0)}});
  }
  return pairs;
}

std::vector<Geodetic> height_places(const Scope& scope) {
  const std::size_t count = scope.full ? 20000 : 4000;
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Geodetic> result{{90, 0}, {-90, 0}, {0, 0}, {0, 90}, {0, 180}};
  while (result.size() < count) {
    const double lat = std::asin(unit(random)) / kDegree, lon = 180.0 * unit(random);
    switch (result.size() % 5) {
      case 0:
        result.push_back({lat, 90.0 * static_cast<double>(result.size() / 5 % 4)});
        break;
      case 1:
        result.push_back({0.0, lon});
        break;
      default:
        result.push_back({lat, lon});
    }
  }
  return result;
}

std::vector<globe::htm::dvec3> cone_centres(const Scope& scope) {
  const std::size_t count = scope.full ? 100 : 20;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<globe::htm::dvec3> result{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
  while (result.size() < count) {
    const globe::htm::dvec3 u{normal(random), normal(random), normal(random)};
    result.push_back(u / std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z));
  }
  return result;
}

std::vector<PlacePair> land_pairs(const globe::planet::Surface& surface, const Scope& scope, int level) {
  const std::size_t count = scope.full ? 100 : 20;
  const GeographicLib::Geodesic geodesic(surface.ellipsoid().a, surface.ellipsoid().f);
  const auto ground = [&](const Geodetic& place) {
    return globe::planet::height_at(surface, globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg),
                                    level, globe::planet::Interpolation::kLinear)
        .height_m;
  };
  std::vector<PlacePair> result;
  for (Geodetic place : height_places({true})) {
    if (result.size() == count) break;
    const double azimuth_deg = 137.0 * static_cast<double>(result.size());
    Geodetic other;
    geodesic.Direct(place.lat_deg, place.lon_deg, azimuth_deg, kApart_m, other.lat_deg, other.lon_deg);
    place.h_m = ground(place);
    other.h_m = ground(other);
    if (std::min(place.h_m, other.h_m) > 50.0) result.push_back({place, other});
  }
  return result;
}

std::vector<Edge> sample_edges() {
  constexpr int kEdges = 400;
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Edge> edges;
  for (int k = 0; k < kEdges; ++k) {
    const double turn = std::numbers::pi * unit(random);
    edges.push_back({{std::cos(turn), std::sin(turn)}, 8.0 * unit(random)});
  }
  return edges;
}

converters::Harmonics known_relief() { return {64, 20261124, 1000.0}; }

MapSample map_sample(const Scope& scope) {
  return scope.full ? MapSample{1024, 1536, 8} : MapSample{512, 768, 7};
}

}  // namespace app::accuracy
