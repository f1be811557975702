#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "converters/layer_output.h"
#include "globe/planet/grid.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/surface.h"

namespace tests {

/// Height of a node; must be the same by every name of the node.
using HeightOfNode = std::function<double(const globe::planet::Node&)>;

/// A height in [low, high] that depends on the node alone, without any order.
inline HeightOfNode hashed_heights(std::uint64_t seed, double low_m, double high_m) {
  return [=](const globe::planet::Node& node) {
    const auto hash = globe::planet::vertex_hash(seed, globe::planet::octahedral_key(node));
    return low_m + (high_m - low_m) * std::ldexp(static_cast<double>(hash >> 11), -53);
  };
}

/// Writes a planet of these heights, rounded to float, with all the layers that `globe convert` makes of a
/// height map.
inline void write_node_planet(const std::filesystem::path& folder, int level,
                              const globe::geo::Ellipsoid& ellipsoid, const HeightOfNode& height,
                              const std::string& body = "other") {
  std::filesystem::create_directories(folder);
  converters::MemoryBudget budget{std::size_t{1} << 32, folder};
  converters::NodeGrid<float> heights(level, 1, budget);
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    for (int j = 0; j < heights.side(); ++j) {
      for (int i = 0; i < heights.side(); ++i)
        *heights.at(d, i, j) = static_cast<float>(height({d, level, i, j}));
    }
  }
  globe::planet::PlanetFile file;
  file.info = {"nodes", body, "", ellipsoid, "ellipsoid", converters::kTileSize, {}, {}};
  file.layers = converters::write_layers(converters::height_layers(std::move(heights), ellipsoid, budget),
                                         folder, [](double) {});
  globe::planet::write_planet_file(folder, std::move(file));
}

inline std::shared_ptr<const globe::planet::Surface> open_surface(const std::filesystem::path& folder) {
  using globe::planet::Dataset;
  return globe::planet::Surface::from_dataset(
      std::make_shared<const Dataset>(Dataset::open(folder, std::size_t{64} << 20)));
}

}  // namespace tests
