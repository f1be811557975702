#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "app/bench.h"
#include "globe/geo/geodesic.h"
#include "globe/planet/sight.h"

namespace app {
namespace {

using globe::geo::Geodetic;
using globe::planet::Surface;

using Pairs = std::vector<std::pair<Geodetic, Geodetic>>;

Pairs random_pairs(std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto place = [&] {
    return Geodetic{std::asin(unit(random)) * 57.29577951308232, 180.0 * unit(random)};
  };
  Pairs pairs(count);
  for (auto& [a, b] : pairs) {
    a = place();
    b = place();
  }
  return pairs;
}

Benchmark distance_benchmark() {
  constexpr std::size_t kPairs = 10000;
  return {"geo.distance", kPairs,
          [pairs = random_pairs(kPairs), solver = globe::geo::GeodesicSolver(globe::geo::kWgs84),
           sum = std::make_shared<double>(0.0)] {
            for (const auto& [a, b] : pairs) *sum += solver.inverse(a, b).s12_m;
          }};
}

/// Eyes 2 m above the built-in planet's ground, a tenth of a degree to three degrees apart.
Benchmark sight_benchmark() {
  constexpr std::size_t kPairs = 100;
  const std::shared_ptr<const Surface> surface = Surface::builtin(1);
  const int level = surface->data_level();
  Pairs pairs = random_pairs(kPairs);
  for (std::size_t k = 0; k < kPairs; ++k) {
    auto& [a, b] = pairs[k];
    b = {std::clamp(a.lat_deg + 0.1 + 0.02 * static_cast<double>(k), -90.0, 90.0), a.lon_deg + 0.5};
    for (Geodetic* eye : {&a, &b}) eye->h_m = globe::planet::sight_ground(*surface, *eye, {level}) + 2.0;
  }
  return {"planet.sight", kPairs, [pairs, surface, level, seen = std::make_shared<int>(0)] {
            for (const auto& [a, b] : pairs)
              *seen += globe::planet::sight(*surface, a, b, {level, 0.13}).visible;
          }};
}

}  // namespace

std::vector<BenchmarkEntry> line_benchmarks() {
  return {{"geo.distance", distance_benchmark}, {"planet.sight", sight_benchmark}};
}

}  // namespace app
