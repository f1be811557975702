#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "converters/inset_output.h"
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
  for (const converters::Job& job : converters::jobs_of(converters::JobLayer::kHeight, level)) {
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

/// A round inset: weight 1 within `inner` of its centre, 0 from `outer` on, smooth between them.
struct RoundInset {
  std::string name;
  int level = 9;
  globe::planet::dvec3 centre{0.0};  ///< a direction of any length
  double inner = 0, outer = 0;       ///< chords on the unit sphere
  HeightOfNode height;

  double weight(const globe::planet::dvec3& u) const {
    const double t = (outer - glm::distance(u, glm::normalize(centre))) / (outer - inner);
    return t <= 0.0 ? 0.0 : t >= 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t);
  }
  double weight(const globe::planet::Node& node) const { return weight(globe::planet::node_direction(node)); }
};

inline converters::InsetSamples samples_of(const RoundInset& inset) {
  using namespace globe::planet;
  const int n = nodes_per_side(inset.level);
  std::vector<InsetBlock> everywhere;
  for (int d = 0; d < kDiamonds; ++d) everywhere.push_back({d, 0, n, 0, n});
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  converters::InsetSamples samples{{}, converters::InsetGrid<float>(inset.level, everywhere, 0.0f)};
  samples.values.emplace_back(inset.level, everywhere, kUnknown);
  constexpr int kBlock = 16;
  const double known = inset.outer + (kInsetMargin + 2) * 2.5 / n;  // an edge is at most 2.5 / n long
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j0 = 0; j0 <= n; j0 += kBlock) {
      for (int i0 = 0; i0 <= n; i0 += kBlock) {
        const dvec3 corner = node_direction({d, inset.level, i0, j0});
        if (glm::distance(corner, glm::normalize(inset.centre)) > known + 2.0 * kBlock * 2.5 / n) continue;
        for (int j = j0; j < j0 + kBlock && j <= n; ++j) {
          for (int i = i0; i < i0 + kBlock && i <= n; ++i) {
            const Node node{d, inset.level, i, j};
            if (glm::distance(node_direction(node), glm::normalize(inset.centre)) > known) continue;
            samples.values[0].set(d, i, j, static_cast<float>(inset.height(node)));
            samples.weight.set(d, i, j, static_cast<float>(inset.weight(node)));
          }
        }
      }
    }
  }
  return samples;
}

/// Lays an inset over a planet's heights.
inline void add_inset(const std::filesystem::path& folder, const RoundInset& inset) {
  globe::planet::PlanetFile file = globe::planet::read_planet_file(folder);
  file.insets.push_back(
      converters::write_inset(folder, inset.name, "height", samples_of(inset), file.info.tile_size).stored);
  globe::planet::write_planet_file(folder, std::move(file));
}

inline std::shared_ptr<const globe::planet::Surface> open_surface(const std::filesystem::path& folder) {
  using globe::planet::Dataset;
  return globe::planet::Surface::from_dataset(
      std::make_shared<const Dataset>(Dataset::open(folder, std::size_t{64} << 20)));
}

}  // namespace tests
