#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>

#include "globe/planet/scenic.h"
#include "globe/planet/surface.h"

namespace {

using namespace globe::planet;

/// Makes tiles of one level around a place, their parents known; counts nodes with the guard.
void make_tiles(benchmark::State& state, const std::shared_ptr<const Surface>& surface, const dvec3& u) {
  const int level = static_cast<int>(state.range(0));
  const Place place = locate(u, level);
  TileId id = tile_of({place.d, level, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)});
  const int count = nodes_per_side(level) / kTileCells;
  const int span = std::min(16, count);
  const ivec2 first{std::min(id.ti, count - span), std::min(id.tj, count - span)};
  int step = 0;
  for (auto _ : state) {
    state.PauseTiming();
    // A walk as long as the smallest cache or longer, so that every tile is new.
    id.ti = first.x + step % span;
    id.tj = first.y + step / span % span;
    ++step;
    surface->tile(id.parent());
    state.ResumeTiming();
    benchmark::DoNotOptimize(surface->tile(id));
  }
  state.counters["node"] =
      benchmark::Counter(static_cast<double>(id.stride()) * id.stride(),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void builtin(benchmark::State& state) {
  const auto surface = Surface::builtin(1, 0);
  const globe::geo::Geodetic place = scenic_place(*surface).place;
  make_tiles(state, surface, globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg));
}
BENCHMARK(builtin)->Name("surface.tile.builtin")->Arg(9)->Arg(12)->Arg(16)->Arg(22)->Arg(27);

/// The planet folder of GLOBE_BENCH_PLANET, at the Himalaya.
void dataset(benchmark::State& state) {
  const char* folder = std::getenv("GLOBE_BENCH_PLANET");
  if (folder == nullptr) {
    state.SkipWithError("set GLOBE_BENCH_PLANET to a planet folder");
    return;
  }
  const std::size_t cache = std::size_t{64} << 20;
  const auto surface =
      Surface::from_dataset(std::make_shared<const Dataset>(Dataset::open(folder, cache)), 0);
  make_tiles(state, surface, globe::geo::normal_from_degrees(27.99, 86.92));
}
BENCHMARK(dataset)->Name("surface.tile.dataset")->Arg(9)->Arg(12)->Arg(16)->Arg(22)->Arg(27);

void find_scenic_place(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(scenic_place(*Surface::builtin(1)));
}
BENCHMARK(find_scenic_place)->Name("surface.scenic_place")->Unit(benchmark::kMillisecond);

}  // namespace
