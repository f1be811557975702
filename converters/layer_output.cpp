#include "converters/layer_output.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <string>

#include "converters/pyramid.h"
#include "globe/planet/layer_file.h"
#include "globe/planet/mean_height.h"

namespace converters {
namespace {

using globe::planet::kDiamonds;

void write_file(const LayerOutput& layer, int d, const std::filesystem::path& path,
                const std::function<void(int rows)>& written) {
  const globe::planet::StoredLayer& stored = layer.stored;
  globe::planet::LayerFileWriter writer(path, stored.stored_level, stored.info.channels, stored.info.storage,
                                        kTileSize);
  const auto write_levels = [&](const auto& grids) {
    for (const auto& grid : grids) {
      writer.write_level(grid.diamond(d), [&](int rows) {
        grid.drop_pages();
        written(rows);
      });
    }
  };
  if (!layer.parts.empty()) writer.write_level(layer.parts[static_cast<std::size_t>(d)], written);
  write_levels(layer.values);
  write_levels(layer.bytes);
  writer.finish();
}

/// Samples of a pyramid, to tell how far writing has come.
double samples_of(const globe::planet::StoredLayer& layer) {
  double samples = 0;
  for (int level = 0; level <= layer.stored_level; ++level) {
    const double side = globe::planet::nodes_per_side(level) + 1;
    samples += kDiamonds * side * side * layer.info.channels;
  }
  return samples;
}

/// The tiles of a layer, by diamond.
std::vector<std::vector<std::filesystem::path>> parts_of(JobLayer layer, int level, const PartFiles& files) {
  std::vector<std::vector<std::filesystem::path>> parts(kDiamonds);
  for (const Job& job : jobs_of(layer, level))
    parts[static_cast<std::size_t>(job.d)].push_back(files.tiles(job));
  return parts;
}

}  // namespace

std::vector<LayerOutput> height_layers(int level, const Range& all, const PartFiles& files,
                                       const globe::geo::Ellipsoid& ellipsoid, MemoryBudget& budget) {
  std::vector<LayerOutput> layers(4);
  layers[0].stored = {{"height", level, 1, "float32", all.min, all.max}, level, {}};
  layers[0].parts = parts_of(JobLayer::kHeight, level, files);
  layers[1].stored = {{"relief", level, 1, "float32", all.min, all.max}, level - 1, {}};
  const int block_level = globe::planet::block_level(level);
  layers[2].stored = {{"height_range", block_level, 2, "float32", all.min, all.max}, block_level, {}};
  layers[3].stored = {{"height_mean", block_level, 2, "float32", all.min, all.max}, block_level, {}};

  std::vector<NodeGrid<float>>& ranges = layers[2].values;
  std::vector<NodeGrid<float>>& means = layers[3].values;
  ranges.emplace_back(block_level, 2, files.level("height_range"));
  means.emplace_back(block_level, 2, files.level("height_mean"));
  for (int k = block_level - 1; k >= 0; --k) {
    ranges.emplace_back(k, 2, budget);
    range_of_ranges(ranges[ranges.size() - 2], ranges.back());
    means.emplace_back(k, 2, budget);
    mean_of_means(means[means.size() - 2], ellipsoid, means.back());
  }
  if (level == 0) return layers;
  std::vector<NodeGrid<float>>& height = layers[0].values;
  std::vector<NodeGrid<float>>& relief = layers[1].values;
  height.emplace_back(level - 1, 1, files.level("height"));
  relief.emplace_back(level - 1, 1, files.level("relief"));
  for (int k = level - 2; k >= 0; --k) {
    relief.emplace_back(k, 1, budget);
    filter(relief[relief.size() - 2], relief.back());
    height.emplace_back(k, 1, budget);
    subsample(height[height.size() - 2], height.back());
  }
  return layers;
}

LayerOutput color_layer(int level, const PartFiles& files, MemoryBudget& budget) {
  constexpr int kChannels = 3;
  LayerOutput layer;
  layer.stored = {{"color", level, kChannels, "uint8", 0.0, 1.0}, level, {}};
  layer.parts = parts_of(JobLayer::kColor, level, files);
  if (level == 0) return layer;
  // The chain of levels stays in linear light, so that rounding to bytes does not add up.
  NodeGrid<float> fine(level - 1, kChannels, files.level("color"));
  for (int k = level - 1;; --k) {
    layer.bytes.emplace_back(k, kChannels, budget);
    encode_colors(fine, layer.bytes.back());
    if (k == 0) return layer;
    NodeGrid<float> coarse(k - 1, kChannels, budget);
    filter(fine, coarse);
    fine = std::move(coarse);
  }
}

LayerOutput void_layer(int level, const PartFiles& files, MemoryBudget& budget) {
  LayerOutput layer;
  layer.stored = {{"void", level, 1, "uint8", 0.0, 1.0}, level, {}};
  layer.parts = parts_of(JobLayer::kVoid, level, files);
  if (level == 0) return layer;
  NodeGrid<float> fine(level - 1, 1, files.level("void"));
  for (int k = level - 1;; --k) {
    layer.bytes.emplace_back(k, 1, budget);
    encode_marks(fine, layer.bytes.back());
    if (k == 0) return layer;
    NodeGrid<float> coarse(k - 1, 1, budget);
    subsample(fine, coarse);
    fine = std::move(coarse);
  }
}

std::vector<globe::planet::StoredLayer> write_layers(const std::vector<LayerOutput>& layers,
                                                     const std::filesystem::path& folder,
                                                     const std::function<void(double)>& progress) {
  std::vector<globe::planet::StoredLayer> stored;
  double all_samples = 0;
  for (const LayerOutput& layer : layers) {
    stored.push_back(layer.stored);
    stored.back().files.resize(layer.stored.stored_level < 0 ? 0 : kDiamonds);
    all_samples += samples_of(layer.stored);
  }
  std::atomic<double> done = 0;
  // While files go to the disk, the next ones are written.
  std::vector<std::future<void>> published(stored.size() * kDiamonds);
  tbb::parallel_for(0, static_cast<int>(layers.size()) * kDiamonds, 1, [&](int task) {
    const auto index = static_cast<std::size_t>(task / kDiamonds);
    const auto d = static_cast<std::size_t>(task % kDiamonds);
    const globe::planet::StoredLayer& layer = layers[index].stored;
    if (layer.stored_level < 0) return;
    const std::filesystem::path path = folder / (layer.info.name + "_" + std::to_string(d) + ".tif");
    const double row = (double(globe::planet::nodes_per_side(layer.stored_level)) + 1) * layer.info.channels;
    // One under its final name is whole: left by a conversion that was interrupted later.
    if (!std::filesystem::exists(path)) {
      const std::filesystem::path temporary = path.string() + ".partial";
      write_file(layers[index], static_cast<int>(d), temporary, [&](int rows) {
        done = done + row * rows;
        progress(std::min(1.0, done / all_samples));
      });
      stored[index].files[d] = globe::planet::describe_file(temporary);
      stored[index].files[d].name = path.filename().string();
      published[static_cast<std::size_t>(task)] = std::async(std::launch::async, [temporary, path] {
        globe::planet::sync_to_disk(temporary);
        std::filesystem::rename(temporary, path);
      });
    } else {
      stored[index].files[d] = globe::planet::describe_file(path);
    }
  });
  for (std::future<void>& one : published)
    if (one.valid()) one.get();
  return stored;
}

}  // namespace converters
