#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "converters/inset_output.h"
#include "converters/node_planet.h"
#include "globe/planet/grid.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/surface.h"

namespace tests {

using converters::HeightOfNode;
using converters::write_node_planet;

/// A height in [low, high] that depends on the node alone, without any order.
inline HeightOfNode hashed_heights(std::uint64_t seed, double low_m, double high_m) {
  return [=](const globe::planet::Node& node) {
    const auto hash = globe::planet::vertex_hash(seed, globe::planet::octahedral_key(node));
    return low_m + (high_m - low_m) * std::ldexp(static_cast<double>(hash >> 11), -53);
  };
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
