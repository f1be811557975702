#include <memory>
#include <string>
#include <vector>

#include "app/bench_fractal.h"
#include "flat/fractal/low_flight.h"
#include "flat/fractal/terrain.h"

namespace app {
namespace {

namespace fractal = globe::flat::fractal;

/// 256 blocks of 17x17 posts, 10 iterations, along rows that go on for ever.
Benchmark blocks_benchmark(const std::string& name, fractal::Method method, int cached_areas) {
  constexpr int kBlocks = 256;
  fractal::Settings settings;
  settings.method = method;
  struct Run {
    fractal::BlockMaker maker;
    std::vector<float> heights;
    std::int64_t at = 0;
  };
  auto run = std::make_shared<Run>(Run{fractal::BlockMaker(settings, 4, cached_areas), {}, 0});
  run->heights.resize(static_cast<std::size_t>(run->maker.posts_with_rim() * run->maker.posts_with_rim()));
  return {name, kBlocks * 17.0 * 17.0, [run] {
            for (int k = 0; k < kBlocks; ++k, ++run->at)
              run->maker.make({run->at % 64, run->at / 64}, run->heights);
          }};
}

/// What is in view of 128x128 blocks, low over the ground.
Benchmark culling_benchmark(const std::string& name) {
  fractal::TerrainSettings settings;
  settings.pager = {.log2_cells = 3, .log2_blocks = 7};
  auto terrain = std::make_shared<fractal::Terrain>(settings);
  terrain->move_to({0, 0});
  const glm::dvec3 eye(0, 0, terrain->height_m({0, 0}) + 300);
  const glm::dmat4 clip = globe::render::clip_from_relative(fractal::flat_camera(30, -8, 60, 4.0 / 3.0), 1.0);
  return {name, 128.0 * 128.0, [terrain, eye, clip] { terrain->draws(clip, eye); }};
}

/// A block's step eastward of 128x128 blocks of 9x9 posts: a column made, the tree of boxes updated.
Benchmark paging_benchmark(const std::string& name) {
  fractal::TerrainSettings settings;
  settings.pager = {.log2_cells = 3, .log2_blocks = 7};
  auto terrain = std::make_shared<fractal::Terrain>(settings);
  terrain->move_to({0, 0});
  auto east = std::make_shared<double>(0);
  return {name, 128, [terrain, east] { terrain->move_to({* east += 8, 0}); }};
}

}  // namespace

std::vector<BenchmarkEntry> fractal_benchmarks() {
  using fractal::Method;
  std::vector<BenchmarkEntry> entries;
  for (const auto& [method, word] : {std::pair{Method::kDiamondSquare, "diamond_square"},
                                     std::pair{Method::kSquareSquare, "square_square"}}) {
    const std::string name = std::string("flat.fractal.blocks.") + word;
    entries.push_back({name, [=, method = method] { return blocks_benchmark(name, method, 8); }});
    const std::string bare = name + ".no_cache";
    entries.push_back({bare, [=, method = method] { return blocks_benchmark(bare, method, 0); }});
  }
  entries.push_back({"flat.fractal.cull", [] { return culling_benchmark("flat.fractal.cull"); }});
  entries.push_back({"flat.fractal.page", [] { return paging_benchmark("flat.fractal.page"); }});
  return entries;
}

}  // namespace app
