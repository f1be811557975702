#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "converters/node_grid.h"
#include "converters/sampler.h"
#include "converters/source_map.h"

namespace converters::test {

inline constexpr Filter kAllFilters[] = {Filter::kNearest, Filter::kBilinear, Filter::kBicubic,
                                         Filter::kArea};

/// A map in memory: value(column, row, channel).
class FunctionRaster : public RasterSource {
 public:
  using Value = std::function<double(int x, int y, int c)>;
  FunctionRaster(int width, int height, int channels, SampleType type, Value value)
      : value_(std::move(value)) {
    info_.name = "function";
    info_.width = width;
    info_.height = height;
    info_.channels = channels;
    info_.type = type;
    info_.linear_light = type == SampleType::kFloat;
  }
  const RasterInfo& info() const override { return info_; }
  void read_rows(int count, void* out) override {
    std::size_t k = 0;
    for (int end = row_ + count; row_ < end; ++row_) {
      for (int x = 0; x < info_.width; ++x) {
        for (int c = 0; c < info_.channels; ++c, ++k) put(out, k, value_(x, row_, c));
      }
    }
  }

 private:
  void put(void* out, std::size_t k, double value) const {
    switch (info_.type) {
      case SampleType::kUint8:
        static_cast<std::uint8_t*>(out)[k] = static_cast<std::uint8_t>(value);
        break;
      case SampleType::kUint16:
        static_cast<std::uint16_t*>(out)[k] = static_cast<std::uint16_t>(value);
        break;
      case SampleType::kInt16:
        static_cast<std::int16_t*>(out)[k] = static_cast<std::int16_t>(value);
        break;
      case SampleType::kFloat:
        static_cast<float*>(out)[k] = static_cast<float>(value);
        break;
    }
  }

  RasterInfo info_;
  Value value_;
  int row_ = 0;
};

inline MemoryBudget plenty() { return {std::size_t{1} << 32, "/tmp"}; }

inline MapGeometry geometry_of(int width, int height, Registration registration = Registration::kArea,
                               Extent extent = {}) {
  return whole_planet_geometry("map", width, height, extent, registration, Latitude::kGeodetic,
                               globe::geo::kMoon);
}

/// A float map of heights whose samples are f(latitude, longitude in degrees).
inline SourceMap height_map(const MapGeometry& geometry,
                            const std::function<double(double lat, double lon)>& f, MemoryBudget& budget,
                            int factor = 1) {
  FunctionRaster raster(geometry.width, geometry.height, 1, SampleType::kFloat, [&](int x, int y, int) {
    return f(geometry.north_deg - y * geometry.row_step_deg, geometry.west_deg + x * geometry.step_deg);
  });
  return SourceMap(raster, geometry, {}, factor, budget, [](double) {});
}

/// Samples of a stack at every node of a level.
inline NodeGrid<float> sample(const MapStack& maps, int level, MemoryBudget& budget,
                              Gaps gaps = Gaps::kFill) {
  const int channels = maps.channels();
  NodeGrid<float> grid(level, channels, budget);
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    sample_nodes(
        maps, whole_diamond(d, level), gaps,
        [&](int i, int j, int count, const float* values, const float*) {
          std::copy_n(values, count * channels, grid.at(d, i, j));
        },
        [](double) {});
  }
  return grid;
}

/// A stack of maps that outlive it.
inline MapStack stack_of(std::initializer_list<const SourceMap*> maps, Filter filter) {
  MapStack stack;
  for (const SourceMap* map : maps)
    stack.add(std::shared_ptr<const SourceMap>(map, [](const SourceMap*) {}), filter);
  return stack;
}

/// Samples a map of heights at every node of a level.
inline NodeGrid<float> sample(const SourceMap& map, Filter filter, int level, MemoryBudget& budget) {
  return sample(stack_of({&map}, filter), level, budget);
}

/// Runs body(node, value) over all nodes.
template <typename Body>
void for_each_node(const NodeGrid<float>& grid, const Body& body) {
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    for (int j = 0; j < grid.side(); ++j) {
      for (int i = 0; i < grid.side(); ++i)
        body(globe::planet::Node{d, grid.level(), i, j}, *grid.at(d, i, j));
    }
  }
}

/// Nodes whose other names hold other bits.
inline int broken_edges(const NodeGrid<float>& grid) {
  int broken = 0;
  for_each_node(grid, [&](const globe::planet::Node& node, float) {
    const globe::planet::Names all = globe::planet::names(node);
    for (std::size_t k = 1; k < static_cast<std::size_t>(all.count); ++k) {
      const globe::planet::Node& other = all.node[k];
      for (int c = 0; c < grid.channels(); ++c)
        broken += grid.at(node.d, node.i, node.j)[c] != grid.at(other.d, other.i, other.j)[c];
    }
  });
  return broken;
}

}  // namespace converters::test
