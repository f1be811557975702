#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "app/bench.h"
#include "globe/geo/geodesic.h"

namespace app {
namespace {

using globe::geo::Geodetic;

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

}  // namespace

std::vector<BenchmarkEntry> line_benchmarks() { return {{"geo.distance", distance_benchmark}}; }

}  // namespace app
