#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "converters/node_grid.h"
#include "globe/planet/planet_file.h"

namespace converters {

/// Side of the tiles on disk, nodes: a clipmap's update strips touch few samples they do not need.
inline constexpr int kTileSize = 128;

/// A layer ready to be written: finest level first. `planet.layers` lists it without its files.
struct LayerOutput {
  globe::planet::StoredLayer stored;
  std::vector<NodeGrid<float>> values;        ///< of float32 layers
  std::vector<NodeGrid<std::uint8_t>> bytes;  ///< of uint8 layers
};

/// "height", "relief", "height_range" and "height_mean" of heights at their finest level. (The ellipsoid
/// weighs the means.)
std::vector<LayerOutput> height_layers(NodeGrid<float> heights, const globe::geo::Ellipsoid& ellipsoid,
                                       MemoryBudget& budget);

/// "color" of sRGB bytes at their finest level.
LayerOutput color_layer(NodeGrid<std::uint8_t> colors, MemoryBudget& budget);

/// Writes the files of the layers into a folder, one task a file, and returns what planet.json has to list.
std::vector<globe::planet::StoredLayer> write_layers(const std::vector<LayerOutput>& layers,
                                                     const std::filesystem::path& folder,
                                                     const std::function<void(double)>& progress);

}  // namespace converters
