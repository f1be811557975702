// A continent on a planet of level 10: with its pyramids, without them, and node by node.
//
//   build/release/tests/bench/globe_bench --benchmark_filter=summary --benchmark_repetitions=30
//     --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "globe/geo/area.h"
#include "globe/htm/cone.h"
#include "globe/htm/polygon.h"
#include "globe/planet/directions.h"
#include "globe/planet/summary.h"
#include "globe/region/ellipsoid_cone.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace {

using globe::htm::Region;
using globe::planet::Surface;

constexpr int kLevel = 10;

/// Africa, from memory: a coast of 44 corners.
std::shared_ptr<const Region> africa() {
  const std::vector<globe::geo::Geodetic> coast{
      {35.8, -5.9},  {36.8, 3.0},   {37.3, 9.9},   {33.9, 10.1},  {32.4, 15.2},  {30.3, 19.0},  {32.9, 21.7},
      {31.6, 25.1},  {31.2, 29.9},  {31.3, 32.3},  {29.9, 32.6},  {24.0, 35.6},  {18.0, 38.6},  {15.0, 39.7},
      {11.5, 43.2},  {11.8, 51.2},  {4.0, 47.9},   {-1.7, 41.6},  {-6.8, 39.3},  {-15.0, 40.7}, {-19.8, 34.9},
      {-25.9, 32.9}, {-29.9, 31.0}, {-33.9, 25.6}, {-34.8, 20.0}, {-33.9, 18.4}, {-28.6, 16.5}, {-22.9, 14.5},
      {-15.8, 11.8}, {-8.8, 13.2},  {-4.8, 11.8},  {-0.7, 8.8},   {4.0, 9.2},    {4.3, 6.0},    {6.4, 2.4},
      {4.4, -2.0},   {5.3, -4.0},   {4.4, -7.6},   {7.7, -12.8},  {12.5, -16.7}, {14.7, -17.4}, {20.8, -17.0},
      {27.9, -12.9}, {33.6, -7.6}};
  globe::htm::Polygon::Ring ring;
  for (const auto& at : coast) ring.push_back(globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg));
  return std::make_shared<globe::htm::Polygon>(globe::htm::Polygon::Rings{ring});
}

std::shared_ptr<const Region> cone_3000km() {
  return std::make_shared<globe::region::EllipsoidCone>(globe::geo::kWgs84, globe::geo::Geodetic{0, 20}, 3e6);
}

std::shared_ptr<const Region> cone_27deg() {
  return std::make_shared<globe::htm::Cone>(globe::geo::normal_from_degrees(0, 20), 27);
}

/// The built-in planet's relief, written as `globe convert` would.
class Planet {
 public:
  explicit Planet(bool with_means) {
    const auto builtin = Surface::builtin(1);
    const globe::planet::BuiltinPlanet relief(1);
    tests::write_node_planet(folder_.path(), kLevel, globe::geo::kWgs84,
                             [&](const globe::planet::Node& node) {
                               return relief.at(globe::planet::node_direction(node)).height_m;
                             });
    if (!with_means) {
      globe::planet::PlanetFile file = globe::planet::read_planet_file(folder_.path());
      std::erase_if(file.layers, [](const auto& layer) { return layer.info.name == "height_mean"; });
      globe::planet::write_planet_file(folder_.path(), file);
    }
    surface_ = tests::open_surface(folder_.path());
  }
  const Surface& surface() const { return *surface_; }

 private:
  tests::TemporaryFolder folder_;
  std::shared_ptr<const Surface> surface_;
};

const Surface& planet() {
  static const Planet with(true);
  return with.surface();
}

const Surface& older_planet() {
  static const Planet without(false);
  return without.surface();
}

void summary(benchmark::State& state, const Surface& (*surface)(),
             std::shared_ptr<const Region> (*region)()) {
  const Surface& ground = surface();
  const auto asked = region();
  const auto warm = globe::planet::summarize(ground, *asked, kLevel);
  for (auto _ : state) benchmark::DoNotOptimize(globe::planet::summarize(ground, *asked, kLevel));
  state.counters["samples"] = static_cast<double>(warm->samples);
}

/// Every node asked whether it is inside, its height read; nothing of means and areas.
void every_node(benchmark::State& state, std::shared_ptr<const Region> (*region)()) {
  const Surface& ground = planet();
  const auto asked = region();
  double low = 0, high = 0;
  const auto look = [&] {
    low = 1e9, high = -1e9;
    for (int d = 0; d < 4; ++d) {
      for (int tj = 0; tj < 16; ++tj) {
        for (int ti = 0; ti < 16; ++ti) {
          const globe::planet::TileId id{d, kLevel, ti, tj};
          const auto directions = globe::planet::node_directions(id, 0);
          std::vector<float> heights(65 * 65);
          ground.dataset()->read("height", d, kLevel, id.first_i(), id.first_j(), 65, 65, heights.data());
          for (std::size_t k = 0; k < heights.size(); ++k) {
            if (!asked->contains(directions.values[k])) continue;
            low = std::min(low, static_cast<double>(heights[k]));
            high = std::max(high, static_cast<double>(heights[k]));
          }
        }
      }
    }
  };
  for (auto _ : state) {
    look();
    benchmark::DoNotOptimize(low);
  }
  const auto seen = globe::planet::summarize(ground, *asked, kLevel);
  if (seen->lowest.height_m != low || seen->highest.height_m != high) state.SkipWithError("they disagree");
}

BENCHMARK_CAPTURE(summary, africa, planet, africa)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(summary, cone_3000km, planet, cone_3000km)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(summary, cone_27deg, planet, cone_27deg)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(summary, africa_without_pyramid, older_planet, africa)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(every_node, africa, africa)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(every_node, cone_27deg, cone_27deg)->Unit(benchmark::kMillisecond);

}  // namespace
