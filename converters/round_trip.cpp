#include "converters/round_trip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>

#include "converters/node_grid.h"
#include "converters/sampler.h"

namespace converters {
namespace {

/// The map as a file would be read.
class MapRaster : public RasterSource {
 public:
  explicit MapRaster(const HeightMap& map) : map_(map) {
    info_.name = "map";
    info_.width = map.width;
    info_.height = map.height();
    info_.channels = 1;
    info_.type = SampleType::kFloat;
  }
  const RasterInfo& info() const override { return info_; }
  void read_rows(int count, void* out) override {
    const auto width = static_cast<std::size_t>(map_.width);
    std::memcpy(out, map_.metres.data() + static_cast<std::size_t>(next_row_) * width,
                static_cast<std::size_t>(count) * width * sizeof(float));
    next_row_ += count;
  }

 private:
  const HeightMap& map_;
  RasterInfo info_;
  int next_row_ = 0;
};

class GridValues : public NodeValues {
 public:
  explicit GridValues(const NodeGrid<float>& grid) : NodeValues(grid.level(), 1), grid_(grid) {}
  void read(int d, int i0, int j0, int side, float* out) const override {
    for (int j = j0; j <= j0 + side; ++j) out = std::copy_n(grid_.at(d, i0, j), side + 1, out);
  }

 private:
  const NodeGrid<float>& grid_;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

NodeGrid<float> nodes_of(const HeightMap& map, const RoundTripMethod& method, int level,
                         MemoryBudget& budget) {
  MapRaster raster(map);
  MapGeometry geometry =
      whole_planet_geometry("map", map.width, map.height(), {map.west_deg, -90.0, map.west_deg + 360.0, 90.0},
                            Registration::kArea, Latitude::kGeodetic, globe::geo::kWgs84);
  geometry.as_thesis = method.as_thesis;
  MapStack stack;
  stack.add(std::make_shared<const SourceMap>(raster, geometry, ValueRule{}, 1, budget, [](double) {}),
            method.filter);
  NodeGrid<float> grid(level, 1, budget);
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    const RowSink sink = [&](int i, int j, int count, const float* values, const float*) {
      std::copy_n(values, count, grid.at(d, i, j));
    };
    sample_nodes(stack, whole_diamond(d, level), Gaps::kFill, sink, [](double) {});
  }
  return grid;
}

std::vector<float> map_of(const NodeGrid<float>& grid, const HeightMap& map, Sampling sampling) {
  const MapWindow window{map.west_deg, 90.0, map.step_deg(), map.step_deg(), map.width, map.height()};
  const GridValues values(grid);
  const MapSampler sampler(values, sampling, window);
  std::vector<float> back(map.metres.size());
  constexpr int kSide = 128;
  const int across = (map.width + kSide - 1) / kSide, down = (map.height() + kSide - 1) / kSide;
  tbb::parallel_for(0, across * down, [&](int block) {
    const int x0 = block % across * kSide, y0 = block / across * kSide;
    const int nx = std::min(kSide, map.width - x0), ny = std::min(kSide, map.height() - y0);
    std::vector<float> pixels(static_cast<std::size_t>(nx * ny));
    sampler.sample(x0, y0, nx, ny, pixels.data());
    for (int y = 0; y < ny; ++y) {
      std::copy_n(pixels.data() + std::ptrdiff_t{y} * nx, nx,
                  back.data() + std::ptrdiff_t{y0 + y} * map.width + x0);
    }
  });
  return back;
}

void compare(const HeightMap& map, const std::vector<float>& back, RoundTripLoss& loss) {
  double squares = 0, area = 0;
  std::size_t k = 0;
  for (int y = 0; y < map.height(); ++y) {
    const double weight = std::cos((90.0 - (y + 0.5) * map.step_deg()) * std::numbers::pi / 180.0);
    for (int x = 0; x < map.width; ++x, ++k) {
      const double off = static_cast<double>(back[k]) - static_cast<double>(map.metres[k]);
      if (std::abs(off) > loss.max_m) {
        loss.max_m = std::abs(off);
        loss.worst_x = x;
        loss.worst_y = y;
      }
      squares += weight * off * off;
      area += weight;
    }
  }
  const auto [low, high] = std::minmax_element(map.metres.begin(), map.metres.end());
  const double span = static_cast<double>(*high) - static_cast<double>(*low);
  loss.rms_m = std::sqrt(squares / area);
  loss.psnr_db =
      loss.rms_m > 0.0 ? 20.0 * std::log10(span / loss.rms_m) : std::numeric_limits<double>::infinity();
}

constexpr std::array<NamedRoundTrip, 6> kMethods{{
    {"nearest", {Filter::kNearest, Sampling::kNearest, false}},
    {"bilinear", {Filter::kBilinear, Sampling::kLinear, false}},
    {"bicubic", {Filter::kBicubic, Sampling::kLinear, false}},
    {"area", {Filter::kArea, Sampling::kLinear, false}},
    {"bicubic, back cubic", {Filter::kBicubic, Sampling::kCubic, false}},
    {"--as-thesis, bilinear", {Filter::kBilinear, Sampling::kLinear, true}},
}};

}  // namespace

std::span<const NamedRoundTrip> round_trip_methods() { return kMethods; }

HeightMap map_of(const Harmonics& harmonics, int width) {
  HeightMap map{width, -180.0, {}};
  map.metres.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(map.height()));
  const double step = map.step_deg();
  tbb::parallel_for(0, map.height(), [&](int y) {
    harmonics.row(90.0 - (y + 0.5) * step, map.west_deg + 0.5 * step, step, width,
                  map.metres.data() + std::ptrdiff_t{y} * width);
  });
  return map;
}

RoundTripLoss round_trip(const HeightMap& map, const RoundTripMethod& method, int level,
                         const HeightMap& truth) {
  MemoryBudget budget{std::numeric_limits<std::size_t>::max() / 2, std::filesystem::temp_directory_path()};
  RoundTripLoss loss;
  const auto begin = std::chrono::steady_clock::now();
  const NodeGrid<float> grid = nodes_of(map, method, level, budget);
  loss.there_s = seconds_since(begin);
  const auto turn = std::chrono::steady_clock::now();
  const std::vector<float> back = map_of(grid, truth, method.sampling);
  loss.back_s = seconds_since(turn);
  const auto side = static_cast<std::uint64_t>(grid.side());
  loss.nodes = globe::planet::kDiamonds * side * side;
  loss.pixels = truth.metres.size();
  compare(truth, back, loss);
  return loss;
}

}  // namespace converters
