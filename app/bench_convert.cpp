
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/bench.h"
#include "converters/job.h"
#include "converters/sampler.h"
#include "globe/base/temporary_folder.h"
#include "globe/planet/tiff_level.h"

// What a conversion does at a node, by filter, and what it takes to pack a node: with the speed of reading,
// the figures that tell which of the three bounds it.

namespace app {
namespace {

using converters::Filter;

/// An int16 map of ridges that do not compress away.
class Ridges : public converters::RasterSource {
 public:
  explicit Ridges(int width) {
    info_.name = "ridges";
    info_.width = width;
    info_.height = width / 2;
    info_.channels = 1;
    info_.type = converters::SampleType::kInt16;
  }
  const converters::RasterInfo& info() const override { return info_; }
  void read_rows(int count, void* out) override {
    auto* to = static_cast<std::int16_t*>(out);
    for (; count > 0; --count, ++row_) {
      for (int x = 0; x < info_.width; ++x)
        *to++ = static_cast<std::int16_t>((x * 37 + row_ * 91) % 113 + (x / 7 + row_ / 5) % 700);
    }
  }

 private:
  converters::RasterInfo info_;
  int row_ = 0;
};

/// A block row of a level with `cells` cells a side, of a map 2048 samples wide.
struct Sampling {
  static constexpr int kWidth = 2048;
  static constexpr int kRows = converters::kTileSize;

  converters::MemoryBudget budget{std::size_t{1} << 30, std::filesystem::temp_directory_path()};
  converters::MapStack maps;
  converters::NodeRect rect;
  std::vector<float> values;
  std::vector<float> weights;

  Sampling(Filter filter, int level) : rect{1, level, 0, 0, 1 << level, kRows} {
    Ridges raster(kWidth);
    const auto geometry =
        converters::whole_planet_geometry("ridges", kWidth, kWidth / 2, {}, converters::Registration::kArea,
                                          converters::Latitude::kGeodetic, globe::geo::kWgs84);
    maps.add(std::make_shared<converters::SourceMap>(raster, geometry, converters::ValueRule{}, 1, budget,
                                                     [](double) {}),
             filter);
    rect.j0 = rect.ni / 4;
    values.resize(static_cast<std::size_t>(rect.ni) * kRows);
    weights.resize(values.size());
  }
  void run() { sample_rect(maps, rect, converters::Gaps::kFill, values.data(), weights.data()); }
};

/// At the level that the map fills, or the one below for the area filter.
Benchmark sampling_benchmark(const char* name, Filter filter, int level) {
  const auto sampling = std::make_shared<Sampling>(filter, level);
  return {name, double(sampling->values.size()), [sampling] { sampling->run(); }};
}

Benchmark packing_benchmark() {
  const auto sampling = std::make_shared<Sampling>(Filter::kBilinear, 9);
  sampling->run();
  const int tile = converters::kTileSize;
  globe::planet::TiffLevel level{sampling->rect.ni, Sampling::kRows, 1, "float32", tile};
  const auto folder = std::make_shared<const globe::TemporaryFolder>("globe-bench");
  return {
      "convert.pack", double(level.tiles_across()) * tile * tile, [sampling, level, folder] {
        const std::filesystem::path path = *folder / "level.tif";
        globe::planet::TiffWriter file(path, true);
        file.begin_level(level);
        std::vector<std::byte> samples;
        for (int x = 0; x < level.width; x += level.tile_size) {
          cut_tile({sampling->values.data(), level.width, level.height, level.width}, x, 0, level, samples);
          file.write_tile(x / level.tile_size, 0, samples);
        }
        file.end_level();
        std::filesystem::remove(path);
      }};
}

}  // namespace

std::vector<BenchmarkEntry> convert_benchmarks() {
  const auto entry = [](const char* name, Filter filter, int level) {
    return BenchmarkEntry{name, [=] { return sampling_benchmark(name, filter, level); }};
  };
  return {entry("convert.sample.nearest", Filter::kNearest, 9),
          entry("convert.sample.bilinear", Filter::kBilinear, 9),
          entry("convert.sample.bicubic", Filter::kBicubic, 9),
          entry("convert.sample.area", Filter::kArea, 8),
          {"convert.pack", packing_benchmark}};
}

}  // namespace app
