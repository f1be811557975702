#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "converters/block_row.h"
#include "converters/node_grid.h"
#include "globe/planet/planet_file.h"

namespace converters {

/// A layer ready to be written: its finest level first.
struct LayerOutput {
  globe::planet::StoredLayer stored;  ///< without its files
  /// Tiles of the finest level, by diamond, as jobs left them; empty where `values` or `bytes` have it.
  std::vector<std::vector<std::filesystem::path>> parts;
  std::vector<NodeGrid<float>> values;        ///< of float32 layers
  std::vector<NodeGrid<std::uint8_t>> bytes;  ///< of uint8 layers
};

/// "height", "relief", "height_range" and "height_mean" from what the jobs of a level left. (The ellipsoid
/// weighs the means.)
std::vector<LayerOutput> height_layers(int level, const Range& all, const PartFiles& files,
                                       const globe::geo::Ellipsoid& ellipsoid, MemoryBudget& budget);

/// "color" likewise.
LayerOutput color_layer(int level, const PartFiles& files, MemoryBudget& budget);

/// "void" likewise.
LayerOutput void_layer(int level, const PartFiles& files, MemoryBudget& budget);

/// Writes the files of the layers into a folder, one task a file, and returns what planet.json has to list.
/// Each appears under its name when it is whole.
std::vector<globe::planet::StoredLayer> write_layers(const std::vector<LayerOutput>& layers,
                                                     const std::filesystem::path& folder,
                                                     const std::function<void(double)>& progress);

}  // namespace converters
