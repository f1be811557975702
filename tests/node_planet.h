#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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
  const converters::PartFiles parts{folder / "work"};
  std::filesystem::create_directories(parts.folder);
  const converters::NodeSource nodes = [&](const converters::NodeRect& rect,
                                           const converters::RowSink& sink) {
    std::vector<float> row(static_cast<std::size_t>(rect.ni));
    const std::vector<float> valid(row.size(), 1.0F);
    for (int j = rect.j0; j < rect.j0 + rect.nj; ++j) {
      for (int i = 0; i < rect.ni; ++i)
        row[static_cast<std::size_t>(i)] = static_cast<float>(height({rect.d, level, rect.i0 + i, j}));
      sink(rect.i0, j, rect.ni, row.data(), valid.data());
    }
  };
  converters::Range all{1e9, -1e9};
  for (const converters::Job& job : converters::jobs_of(converters::MapKind::kHeights, level)) {
    const converters::Range range = converters::run_job(job, nodes, ellipsoid, parts, [](double) {});
    all = {std::min(all.min, range.min), std::max(all.max, range.max)};
  }
  globe::planet::PlanetFile file;
  file.info = {"nodes", body, "", ellipsoid, "ellipsoid", converters::kTileSize, {}, {}};
  file.layers = converters::write_layers(converters::height_layers(level, all, parts, ellipsoid, budget),
                                         folder, [](double) {});
  globe::planet::write_planet_file(folder, std::move(file));
  std::filesystem::remove_all(parts.folder);
}

inline std::shared_ptr<const globe::planet::Surface> open_surface(const std::filesystem::path& folder) {
  using globe::planet::Dataset;
  return globe::planet::Surface::from_dataset(
      std::make_shared<const Dataset>(Dataset::open(folder, std::size_t{64} << 20)));
}

}  // namespace tests
